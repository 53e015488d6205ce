#include "core/analysis/sensor_calibration/SensorReading.h"

#include <algorithm>
#include <cmath>

#include "core/dsp/RoughnessIndex.h"
#include "core/dsp/TaxelTrack.h"

namespace tacto {

namespace {

/// The stretch that every sample lies in; nothing without samples.
std::optional<TimeInterval> stretchOf(const SensorSamples& samples) {
    std::optional<TimeInterval> out;
    for (const auto& block : samples.blocks) {
        for (const double t : block.t_s) {
            if (!std::isfinite(t)) continue;
            if (!out) out = TimeInterval{t, t};
            out->begin_s = std::min(out->begin_s, t);
            out->end_s = std::max(out->end_s, t);
        }
    }
    return out;
}

Result<std::vector<RoughnessFrame>> framesOf(const SensorSamples& samples, RoughnessSettings settings,
                                             SpectralFeature spectral, TaxelFeature taxel, const SensorRest& rest,
                                             double& period_s) {
    settings.spectral = spectral;
    settings.taxel = taxel;
    auto chain = RoughnessChain::create(samples.streams, settings, {}, samples.serial);
    if (!chain) return failure(chain);
    (*chain)->presetRest(rest.levels);
    std::vector<RoughnessFrame> frames;
    (*chain)->feed(samples.blocks, frames);
    (*chain)->finish(frames);
    period_s = (*chain)->framePeriod_s();
    return frames;
}

double meanOver(const std::vector<RoughnessFrame>& frames, double RoughnessFrame::*member, bool slidingOnly) {
    std::vector<double> present;
    for (const auto& frame : frames) {
        if (frame.contact && (frame.sliding || !slidingOnly) && frame.*member > 0) present.push_back(frame.*member);
    }
    return statisticsOf(present).mean;
}

}  // namespace

const StreamInfo* streamOf(const SensorSamples& samples, StreamKind kind) noexcept {
    const auto at = std::find_if(samples.streams.begin(), samples.streams.end(),
                                 [kind](const StreamInfo& info) { return info.kind == kind; });
    return at == samples.streams.end() ? nullptr : &*at;
}

Statistics levelOf(const SensorSamples& samples, StreamKind kind, std::size_t channel) {
    std::vector<double> values;
    for (std::size_t s = 0; s < samples.streams.size(); ++s) {
        const auto& info = samples.streams[s];
        if (info.kind != kind || channel >= info.channels) continue;
        const auto& block = samples.blocks[s];
        for (std::size_t i = 0; i < block.samples(); ++i) {
            const double value = block.values[i * info.channels + channel];
            if (std::isfinite(value)) values.push_back(value);
        }
    }
    return statisticsOf(values);
}

Result<SensorRest> readRest(const SensorSamples& samples, const RoughnessSettings& settings) {
    const auto stretch = stretchOf(samples);
    if (!stretch || !(stretch->end_s - stretch->begin_s >= TaxelTrack::kShortestRest_s)) {
        return fail(ErrorCode::InvalidArgument, "the fingertip at rest: {} s of samples; at least {} s are expected",
                    stretch ? stretch->end_s - stretch->begin_s : 0.0, TaxelTrack::kShortestRest_s);
    }
    DeclaredIntervals declared;
    declared.baseline = stretch;
    auto chain = RoughnessChain::create(samples.streams, settings, declared, samples.serial);
    if (!chain) return failure(chain);
    std::vector<RoughnessFrame> frames;
    (*chain)->feed(samples.blocks, frames);
    (*chain)->finish(frames);
    for (const auto& frame : frames) {
        // Without force contact is assumed, not seen.
        if (frame.contact && streamOf(samples, StreamKind::Force) != nullptr) {
            return fail(ErrorCode::InvalidArgument,
                        "the fingertip at rest: it was in contact {} s after the start; nothing touching is expected",
                        frame.t_s - stretch->begin_s);
        }
    }
    const auto* levels = (*chain)->rest();
    if (levels == nullptr) {
        return fail(ErrorCode::InvalidArgument, "the fingertip at rest: {} s of samples gave no baseline",
                    stretch->end_s - stretch->begin_s);
    }
    SensorRest out;
    out.levels = *levels;
    for (const auto& info : (*chain)->streams()) {
        if (info.kind == StreamKind::Taxels) out.taxelUnit = info.unit;
    }
    if (const auto* acceleration = streamOf(samples, StreamKind::Acceleration)) out.restUnit = acceleration->unit;
    return out;
}

Result<SlideReading> readSlide(const SensorSamples& samples, const RoughnessSettings& settings,
                               const SensorRest& rest) {
    SlideReading out;
    auto relative =
        framesOf(samples, settings, SpectralFeature::Relative, TaxelFeature::Static, rest, out.framePeriod_s);
    if (!relative) return failure(relative);
    auto absolute =
        framesOf(samples, settings, SpectralFeature::Absolute, TaxelFeature::Dynamic, rest, out.framePeriod_s);
    if (!absolute) return failure(absolute);
    out.h = meanOver(*relative, &RoughnessFrame::h, true);
    out.vStatic = meanOver(*relative, &RoughnessFrame::v, false);
    out.hAbs = meanOver(*absolute, &RoughnessFrame::h, true);
    out.vDynamic = meanOver(*absolute, &RoughnessFrame::v, false);
    out.force_n = levelOf(samples, StreamKind::Force).mean;
    out.frames = *relative;
    for (std::size_t i = 0; i < out.frames.size(); ++i) {
        auto& frame = out.frames[i];
        if (settings.spectral == SpectralFeature::Absolute) frame.h = (*absolute)[i].h;
        if (settings.taxel == TaxelFeature::Dynamic) frame.v = (*absolute)[i].v;
        if (frame.contact && frame.sliding) ++out.slidingFrames;
    }
    if (out.slidingFrames == 0) {
        return fail(ErrorCode::Device, "no sliding contact was felt in {} frames; a finger that slides is expected",
                    out.frames.size());
    }
    return out;
}

double roughnessOf(const SlideReading& slide, const RoughnessSettings& settings) {
    RoughnessIndex index(settings, slide.framePeriod_s);
    std::vector<double> values;
    for (const auto& frame : slide.frames) {
        const Motion motion = !frame.contact ? Motion::NoContact : frame.sliding ? Motion::Sliding : Motion::Resting;
        const double r = index.next(frame.t_s, motion, frame.h, frame.v);
        if (motion == Motion::Sliding && std::isfinite(r)) values.push_back(r);
    }
    return statisticsOf(values).mean;
}

}  // namespace tacto
