// RoughnessAnalysis.h - processes a whole recording with the roughness chain and summarises the result.
//
// Thread-safety: pure functions.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/Statistics.h"
#include "core/dsp/RoughnessChain.h"

namespace tacto {

/// Statistics over contact frames; absent values are ignored.
struct RoughnessSummary {
    std::size_t frames = 0;
    std::size_t contactFrames = 0;
    double rate_hz = 0;  ///< rate of the stream that sets the frames: acceleration, else taxels, else force
    double frameRate_hz = 0;
    std::vector<std::string> flags;
    Statistics h, v, R, pressure_pa, P;
    /// R of the whole recording as one slide, 0..1: computed from the means of its features and only then limited to
    /// 0..1 (RoughnessIndex::ofSlide()). The U of R applies to this value. NaN if nothing slid.
    double slideR = std::numeric_limits<double>::quiet_NaN();
};

struct RoughnessResult {
    std::vector<RoughnessFrame> frames;
    RoughnessSummary summary;
};

/// Processes a whole recording with RoughnessChain. A declared baseline is used for all frames, wherever it lies.
/// Errors: as RoughnessChain::create(); InvalidArgument if the blocks hold no usable sample.
[[nodiscard]] Result<RoughnessResult> analyseRoughness(std::span<const StreamInfo> streams,
                                                       std::span<const SampleBlock> blocks,
                                                       const RoughnessSettings& settings,
                                                       const DeclaredIntervals& declared = {},
                                                       std::string_view serial = {});

/// Returns the mean of a feature over contact frames that have it, or only over sliding ones. NaN if there are none.
[[nodiscard]] double meanFeature(std::span<const RoughnessFrame> frames, double RoughnessFrame::*feature,
                                 bool slidingOnly);

[[nodiscard]] RoughnessSummary summarise(std::span<const RoughnessFrame> frames);

/// Returns frames.csv for the command line: "t_s,contact,sliding,h,v,R,pressure_pa,P"; absent values are empty.
[[nodiscard]] std::string framesCsv(std::span<const RoughnessFrame> frames);

}  // namespace tacto
