// RoughnessAnalysis.h - a whole recording through the roughness chain, and what to say about it.
//
// Thread-safety: pure functions.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/Statistics.h"
#include "core/dsp/RoughnessChain.h"

namespace tacto {

/// Statistics are over contact frames, absent values left out.
struct RoughnessSummary {
    std::size_t frames = 0;
    std::size_t contactFrames = 0;
    double rate_hz = 0;  ///< rate of the stream that paces the frames: acceleration, else taxels, else force
    double frameRate_hz = 0;
    std::vector<std::string> flags;
    Statistics h, v, R, pressure_pa, P;
    /// R of the recording taken as one slide, 0..1: of the means of its features, held within 0..1 last
    /// (RoughnessIndex::ofSlide()). What the U of R is of. NaN where nothing slid.
    double slideR = std::numeric_limits<double>::quiet_NaN();
};

struct RoughnessResult {
    std::vector<RoughnessFrame> frames;
    RoughnessSummary summary;
};

/// Runs a whole recording through RoughnessChain. A declared baseline serves every frame, wherever it lies.
/// Errors: as RoughnessChain::create(); InvalidArgument when the blocks hold no usable sample.
[[nodiscard]] Result<RoughnessResult> analyseRoughness(std::span<const StreamInfo> streams,
                                                       std::span<const SampleBlock> blocks,
                                                       const RoughnessSettings& settings,
                                                       const DeclaredIntervals& declared = {},
                                                       std::string_view serial = {});

/// Mean of a feature over the frames of contact that have it, or over the sliding ones among them; NaN without one.
[[nodiscard]] double meanFeature(std::span<const RoughnessFrame> frames, double RoughnessFrame::*feature,
                                 bool slidingOnly);

[[nodiscard]] RoughnessSummary summarise(std::span<const RoughnessFrame> frames);

/// frames.csv of the command line: "t_s,contact,sliding,h,v,R,pressure_pa,P", absent values empty.
[[nodiscard]] std::string framesCsv(std::span<const RoughnessFrame> frames);

}  // namespace tacto
