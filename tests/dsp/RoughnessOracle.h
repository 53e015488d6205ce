// RoughnessOracle.h - a second, slow implementation of science.md sections 2 and 3 from their text: direct difference
// equation, direct Fourier sums, whole arrays. For regular streams without NaN. It shares no code with core/dsp.
//
// Thread-safety: pure functions.
#pragma once

#include <span>
#include <vector>

#include "core/base/Stream.h"
#include "core/dsp/RoughnessChain.h"

namespace tacto::test {

/// All streams must start at t = 0. Uses `declared.baseline`, rest before contact and the same assumptions.
[[nodiscard]] std::vector<RoughnessFrame> oracleFrames(std::span<const StreamInfo> streams,
                                                       std::span<const SampleBlock> blocks,
                                                       const RoughnessSettings& settings,
                                                       const DeclaredIntervals& declared = {});

/// A simulated slide, always equal: rest to 1 s, static touch to 1.5 s, sliding to 3 s, static to 4.5 s, lifted.
struct Slide {
    std::vector<StreamInfo> streams;
    std::vector<SampleBlock> blocks;
};
[[nodiscard]] Slide makeSlide(double acceleration_hz, std::size_t axes, double force_hz, double taxel_hz,
                              std::size_t taxels, double seconds = 6);

/// Expects equal frames: NaN equals NaN; other values agree within `tolerance`, relative.
void expectSameFrames(std::span<const RoughnessFrame> actual, std::span<const RoughnessFrame> expected,
                      double tolerance);

}  // namespace tacto::test
