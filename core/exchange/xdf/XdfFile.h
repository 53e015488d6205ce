// XdfFile.h - reads XDF 1.0 files, as LabRecorder writes them, also packed by gzip (.xdfz, .xdf.gz).
//
// Every length is checked against what is left of the file before anything is allocated for it: reading takes at most
// the file's size and sixteen times what stands in it as samples. Chunks of an unknown kind are passed over. After a
// damaged one reading goes on behind the next boundary, and a warning says what was left out. Where a stamp is deduced
// from one that was lost, the sample is left out too.
//
// Clock offsets are applied (ClockLine.h). A stream whose clock was reset is not to be used, and its obstacle says
// when that was. Stamps are never smoothed.
//
// Thread-safety: pure function that reads a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "core/acquisition/SignalFile.h"

namespace tacto {

/// The most bytes that are unpacked of a packed file: 1 GiB. A small file can say of itself that it holds any number.
inline constexpr std::uint64_t kMaxUnpacked = std::uint64_t{1} << 30;

/// Whether the first bytes of a file, some hundred of them, are those of an XDF file, packed or not.
[[nodiscard]] bool beginsAsXdf(std::string_view head) noexcept;

/// Errors: as readTextFile() and gunzip(); ParseError for a file that does not begin as XDF does.
[[nodiscard]] Result<SignalFile> readXdf(const std::filesystem::path& path);

}  // namespace tacto
