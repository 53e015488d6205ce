#include "core/dsp/RoughnessAnalysis.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

#include "core/dsp/RoughnessIndex.h"

namespace tacto {

namespace {

double paceRate_hz(std::span<const StreamInfo> streams) {
    for (const auto kind : {StreamKind::Acceleration, StreamKind::Taxels, StreamKind::Force}) {
        for (const auto& info : streams) {
            if (info.kind == kind) return info.rate_hz;
        }
    }
    return 0;
}

Statistics statisticsOver(std::span<const RoughnessFrame> frames, double RoughnessFrame::*member) {
    std::vector<double> present;
    for (const auto& frame : frames) {
        if (frame.contact && !std::isnan(frame.*member)) present.push_back(frame.*member);
    }
    return statisticsOf(present);
}

void runWhole(RoughnessChain& chain, std::span<const SampleBlock> blocks, std::vector<RoughnessFrame>& frames) {
    chain.feed(blocks, frames);
    chain.finish(frames);
}

}  // namespace

double meanFeature(std::span<const RoughnessFrame> frames, double RoughnessFrame::*feature, bool slidingOnly) {
    std::vector<double> present;
    for (const auto& frame : frames) {
        if (frame.contact && (frame.sliding || !slidingOnly) && frame.*feature > 0) present.push_back(frame.*feature);
    }
    return statisticsOf(present).mean;
}

RoughnessSummary summarise(std::span<const RoughnessFrame> frames) {
    RoughnessSummary out;
    out.frames = frames.size();
    for (const auto& frame : frames) out.contactFrames += frame.contact ? 1 : 0;
    out.h = statisticsOver(frames, &RoughnessFrame::h);
    out.v = statisticsOver(frames, &RoughnessFrame::v);
    out.R = statisticsOver(frames, &RoughnessFrame::R);
    out.pressure_pa = statisticsOver(frames, &RoughnessFrame::pressure_pa);
    out.P = statisticsOver(frames, &RoughnessFrame::P);
    return out;
}

Result<RoughnessResult> analyseRoughness(std::span<const StreamInfo> streams, std::span<const SampleBlock> blocks,
                                         const RoughnessSettings& settings, const DeclaredIntervals& declared,
                                         std::string_view serial) {
    if (blocks.size() != streams.size()) {
        return invalid("roughness: {} streams and {} blocks of samples; as many were expected", streams.size(),
                       blocks.size());
    }
    auto chain = RoughnessChain::create(streams, settings, declared, serial);
    if (!chain) return failure(chain);

    RoughnessResult result;
    runWhole(**chain, blocks, result.frames);
    auto flags = (*chain)->flags().texts();
    if (declared.baseline) {
        // The baseline may come after frames that need it, so the first pass was made to find it.
        if (const auto* rest = (*chain)->rest()) {
            const RestLevels levels = *rest;
            (*chain)->presetRest(levels);
            (*chain)->reset();
            result.frames.clear();
            runWhole(**chain, blocks, result.frames);
        }
    }
    if (result.frames.empty()) {
        return invalid("roughness: the recording holds no complete frame; at least 64 ms without a gap were expected");
    }
    result.summary = summarise(result.frames);
    if (std::ranges::any_of(result.frames, [](const auto& frame) { return frame.contact && frame.sliding; })) {
        const double R = RoughnessIndex::ofSlide(settings, meanFeature(result.frames, &RoughnessFrame::h, true),
                                                 meanFeature(result.frames, &RoughnessFrame::v, false));
        result.summary.slideR = std::isnan(R) ? R : std::clamp(R, 0.0, 1.0);
    }
    result.summary.rate_hz = paceRate_hz(streams);
    result.summary.frameRate_hz = 1 / (*chain)->framePeriod_s();
    result.summary.flags = std::move(flags);
    return result;
}

std::string framesCsv(std::span<const RoughnessFrame> frames) {
    std::string out = "t_s,contact,sliding,h,v,R,pressure_pa,P\n";
    auto to = std::back_inserter(out);
    for (const auto& frame : frames) {
        fmt::format_to(to, "{},{:d},{:d}", frame.t_s, frame.contact, frame.sliding);
        for (const double value : {frame.h, frame.v, frame.R, frame.pressure_pa, frame.P}) {
            if (std::isnan(value)) {
                out += ',';
            } else {
                fmt::format_to(to, ",{}", value);
            }
        }
        out += '\n';
    }
    return out;
}

}  // namespace tacto
