#include "core/analysis/sensor_calibration/SensorReading.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/statistics/UncertaintyBudget.h"
#include "core/dsp/RoughnessAnalysis.h"
#include "core/dsp/RoughnessIndex.h"
#include "core/dsp/TaxelTrack.h"

namespace tacto {

namespace {

/// Returns the time interval with all samples; nothing without samples.
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
                                             SpectralFeature spectral, TaxelFeature taxel, const SensorRest& rest) {
    settings.spectral = spectral;
    settings.taxel = taxel;
    auto chain = RoughnessChain::create(samples.streams, settings, {}, samples.serial);
    if (!chain) return failure(chain);
    (*chain)->presetRest(rest.levels);
    std::vector<RoughnessFrame> frames;
    (*chain)->feed(samples.blocks, frames);
    (*chain)->finish(frames);
    return frames;
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
        return invalid("the fingertip at rest: {} s of samples; at least {} s are expected",
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
        // Without a force sensor, contact is only assumed.
        if (frame.contact && streamOf(samples, StreamKind::Force) != nullptr) {
            return invalid(
                "the fingertip at rest: it was in contact {} s after the start; nothing touching is expected",
                frame.t_s - stretch->begin_s);
        }
    }
    const auto* levels = (*chain)->rest();
    if (levels == nullptr) {
        return invalid("the fingertip at rest: {} s of samples gave no baseline", stretch->end_s - stretch->begin_s);
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
    auto relative = framesOf(samples, settings, SpectralFeature::Relative, TaxelFeature::Static, rest);
    if (!relative) return failure(relative);
    auto absolute = framesOf(samples, settings, SpectralFeature::Absolute, TaxelFeature::Dynamic, rest);
    if (!absolute) return failure(absolute);
    out.h = meanFeature(*relative, &RoughnessFrame::h, true);
    out.vStatic = meanFeature(*relative, &RoughnessFrame::v, false);
    out.hAbs = meanFeature(*absolute, &RoughnessFrame::h, true);
    out.vDynamic = meanFeature(*absolute, &RoughnessFrame::v, false);
    out.force_n = levelOf(samples, StreamKind::Force).mean;
    for (const auto& frame : *relative) out.slidingFrames += frame.contact && frame.sliding ? 1 : 0;
    if (out.slidingFrames == 0) {
        return fail(ErrorCode::Device, "no sliding contact was felt in {} frames; a finger that slides is expected",
                    relative->size());
    }
    return out;
}

double roughnessOf(const SlideReading& slide, const RoughnessSettings& settings) {
    return RoughnessIndex::ofSlide(settings, settings.spectral == SpectralFeature::Relative ? slide.h : slide.hAbs,
                                   settings.taxel == TaxelFeature::Static ? slide.vStatic : slide.vDynamic);
}

double meanUncertainty(const SensorSamples& samples, StreamKind kind) {
    for (std::size_t s = 0; s < samples.streams.size(); ++s) {
        if (samples.streams[s].kind != kind) continue;
        const auto& block = samples.blocks[s];
        const std::size_t part = block.samples() / kForceParts;
        if (part < 2) return kNaN;
        std::vector<double> means;
        for (std::size_t k = 0; k < kForceParts; ++k) {
            double sum = 0;
            for (std::size_t i = k * part; i < (k + 1) * part; ++i)
                sum += block.values[i * samples.streams[s].channels];
            means.push_back(sum / static_cast<double>(part));
        }
        return statisticsOf(means).sd / std::sqrt(static_cast<double>(kForceParts));
    }
    return kNaN;
}

WeightError weightError(const WeightReading& reading, const ForceInUse& atRest, double weightTolerance,
                        double gravityTolerance) {
    if (!reading.inUse) return {};
    constexpr double kFreedom = kForceParts - 1;
    const double half = std::sqrt(3.0), newtons = reading.reference_n;
    const auto budget =
        combine({{"tolerance of the weight", Distribution::Rectangular, weightTolerance, half, newtons},
                 {"tolerance of local gravity", Distribution::Rectangular, gravityTolerance, half, newtons},
                 {"reading under the weight", Distribution::Student, reading.inUse->uncertainty, 1, 1, kFreedom},
                 {"reading at rest", Distribution::Student, atRest.uncertainty, 1, 1, kFreedom}});
    return {reading.inUse->mean - atRest.mean - newtons, budget ? budget->expanded : kNaN};
}

namespace {

/// U from the scatter `u` and from the references' common tolerances times `scale`.
double expandedOf(double u, double freedom, const std::vector<double>& tolerances, double scale) {
    if (std::isnan(u)) return u;
    std::vector<Contribution> rows{{"repeatability", Distribution::Student, u, 1, 1, std::max(1.0, freedom)}};
    for (const double tolerance : tolerances)
        rows.push_back({"references", Distribution::Rectangular, tolerance, std::sqrt(3.0), scale});
    // A fingertip has many taxels; 20 000 draws give U to a third of a percent.
    const auto budget = combine(std::move(rows), {.draws = 20'000});
    return budget ? budget->expanded : std::nan("");
}

}  // namespace

Result<SensorScale> fitSensorScale(std::span<const CalibrationReading> readings, const std::vector<double>& tolerances,
                                   std::string_view what) {
    for (const double tolerance : tolerances) {
        if (std::isnan(tolerance) || (tolerance >= 0 && tolerance < 1)) continue;
        return invalid("{}: a tolerance of the references of {}; 0 to below 1 is expected", what, tolerance);
    }
    auto fit = fitCalibration(readings);
    if (!fit) return failure(fit);
    SensorScale out;
    const double gain = fit->gain, freedom = fit->degreesOfFreedom;
    const double se = fit->gainStandardError;
    const double k = studentQuantile(0.975, freedom);
    if (!std::isfinite(gain) || gain == 0 || std::abs(gain) <= k * se) {
        return fail(ErrorCode::Device,
                    "{} does not follow the references: its slope is {:.3g} ± {:.2g}; one that differs from 0 is "
                    "expected",
                    what, gain, k * se);
    }
    out.scale = 1 / gain;
    out.offset = -fit->offset / gain;
    out.scaleU = expandedOf(std::abs(out.scale) * se / std::abs(gain), freedom, tolerances, out.scale);
    // Gain and offset are correlated: cov = - (mean of the references) · var(gain) for an unweighted line.
    double sum = 0;
    std::size_t n = 0;
    for (const auto& reading : readings) {
        if (std::isnan(reading.measured)) continue;
        sum += reading.commanded;
        ++n;
    }
    const double mean = sum / static_cast<double>(n), ratio = fit->offset / gain;
    const double variance =
        fit->offsetStandardError * fit->offsetStandardError + ratio * ratio * se * se + 2 * ratio * mean * se * se;
    out.offsetU = expandedOf(std::sqrt(std::max(0.0, variance)) / std::abs(gain), freedom, tolerances, out.offset);
    out.fit = *std::move(fit);
    return out;
}

}  // namespace tacto
