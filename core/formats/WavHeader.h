// WavHeader.h - the chunks of a RIFF WAVE file in front of its samples.
//
// Thread-safety: pure functions; readWavHeader() moves the file it is given.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/formats/ByteFile.h"
#include "core/measure/Capture.h"

namespace tacto {

struct WavHeader {
    bool isFloat = false;
    unsigned bits = 16;  ///< of a sample, as stored
    unsigned channels = 1;
    double rate_hz = 0;
    std::uint64_t begin = 0;  ///< of the samples in the file
    std::uint64_t bytes = 0;  ///< of samples that are there
    bool cutShort = false;    ///< fewer than announced
    std::string comment;      ///< INFO ICMT
    [[nodiscard]] unsigned frameBytes() const noexcept { return channels * bits / 8; }
};

[[nodiscard]] bool isWav(std::string_view head) noexcept;

/// Errors: Io; ParseError naming file, byte and what was expected.
[[nodiscard]] Result<WavHeader> readWavHeader(ByteFile& file);

/// The header of 32-bit floats: everything before the first sample.
[[nodiscard]] std::string wavHeaderOf(const Capture& capture, std::uint32_t rate_hz);

/// Names, units and start as our own comment keeps them; `capture` has its channels. False for another's comment.
[[nodiscard]] bool takeOwnComment(std::string_view comment, Capture& capture);

}  // namespace tacto
