// SrLayout.h - what a .sr file holds, before libsigrok is asked for it.
//
// A .sr file (sigrok session, version 2) is a zip archive: `version`, `metadata` (an INI text) and the samples, bits of
// the logic channels together in logic-1-1, logic-1-2, ..., each analog channel as 32-bit floats in analog-1-N-1,
// analog-1-N-2, ... (sigrok.org/wiki/File_format:Sigrok/v2).
//
// Checked here because libsigrok 0.5.2 is not careful with what it reads: a unit size of 0 is a division by zero there.
// It says neither how much is coming nor whether all of it came: sizes and checksums are taken from the archive, so
// that memory is taken once, progress is known, and a file that was cut short or damaged is refused.
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
    std::size_t unitSize = 0;  ///< bytes of a logic sample
    std::vector<SrPiece> logic;
    std::vector<std::vector<SrPiece>> analog;  ///< the pieces of each channel
    std::uint64_t bytes = 0;                   ///< bytes of all samples
    /// The text in the metadata; empty where it is not stated. libsigrok reads a minus sign as a huge rate.
    std::string samplerate;
    bool samplerateIsSensible = true;  ///< the rate is not stated, or is a frequency of 0 or above

    [[nodiscard]] static std::uint64_t sum(const std::vector<SrPiece>& pieces) noexcept;
};

/// Errors: NotFound, Io; ParseError naming the file and what is wrong with it.
[[nodiscard]] Result<SrLayout> readSrLayout(const std::filesystem::path& path);

}  // namespace tacto::sigrok_driver
