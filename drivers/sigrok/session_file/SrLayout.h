// SrLayout.h - the layout of a .sr file, read before libsigrok reads the samples.
//
// A .sr file (sigrok session, version 2) is a zip archive of `version`, `metadata` (an INI text) and the samples: the
// bits of all logic channels together in logic-1-1, logic-1-2, ..., and each analog channel as 32-bit floats in
// analog-1-N-1, analog-1-N-2, ... (sigrok.org/wiki/File_format:Sigrok/v2).
//
// Checked here because libsigrok 0.5.2 does not check what it reads: a unit size of 0 makes it divide by zero. It also
// does not say how much data is coming or whether all of it came. Sizes and checksums are therefore read from the
// archive, so that memory is allocated once, progress is known, and a damaged or shortened file is refused.
//
// Thread-safety: pure functions on files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/Result.h"

namespace tacto::sigrok_driver {

/// One piece of a channel's samples, in the order in which libsigrok reads them.
struct SrPiece {
    std::uint64_t bytes = 0;
    std::uint32_t crc = 0;
};

struct SrLayout {
    std::size_t logicChannels = 0;
    std::size_t unitSize = 0;  ///< bytes per logic sample
    std::vector<SrPiece> logic;
    std::vector<std::vector<SrPiece>> analog;  ///< the pieces of each channel
    std::uint64_t bytes = 0;                   ///< bytes of all samples
    /// The sampling rate as the metadata states it, or empty. libsigrok reads a negative rate as a huge one.
    std::string samplerate;
    bool samplerateIsSensible = true;  ///< true if no rate is stated or it is a frequency of 0 or above

    [[nodiscard]] static std::uint64_t sum(const std::vector<SrPiece>& pieces) noexcept;
};

/// Errors: NotFound, Io; ParseError naming the file and the fault.
[[nodiscard]] Result<SrLayout> readSrLayout(const std::filesystem::path& path);

}  // namespace tacto::sigrok_driver
