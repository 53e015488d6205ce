#include "core/measure/PhaseFinder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/measure/PhaseShape.h"

namespace tacto {

namespace {

// A record may hold 10 V and 40 V pulses: a phase is found well below half of the largest and then judged by its own
// plateau. Ringing stays below this, noise below the multiple of its standard deviation.
constexpr double kThreshold = 0.15;
constexpr double kThresholdInNoise = 6;
constexpr double kRelease = 0.6;      // of the threshold: hysteresis
constexpr double kRinging = 0.05;     // of the area of the phase before: more is a phase of its own
constexpr double kLower = 0.6;        // than the phase before: as high is a pulse of its own, however short
constexpr double kRingsFor = 0.5;     // of the phase before, from its end
constexpr double kFlickersFor = 0.1;  // of the phase after, before it: noise on a slow leading edge
constexpr double kRings = 0.05;       // overshoot from which on the tail belongs to the charge

constexpr float kNever = std::numeric_limits<float>::infinity();

/// Of the samples as recorded.
struct Extremes {
    float lowest = kNever;
    float highest = -kNever;
};

template <class Samples>
Extremes extremesOf(const Samples& first, const Samples& last) {
    Extremes found;
    for (auto x = first; x != last; ++x) {
        found.lowest = *x < found.lowest ? *x : found.lowest;
        found.highest = *x > found.highest ? *x : found.highest;
    }
    return found;
}

/// With a declared range: at or beyond its last step. Without: samples that repeat the record's extreme exactly all
/// along a plateau, in a record that otherwise never stays still. Judged on the samples as recorded.
bool isClipped(const FoundPhase& phase, bool restless, const Extremes& recorded) {
    const auto& channel = *phase.view->channel;
    const std::size_t mean = phase.view->mean;
    const auto first = channel.samples.begin() + static_cast<std::ptrdiff_t>(phase.begin * mean);
    const auto last =
        channel.samples.begin() + static_cast<std::ptrdiff_t>(std::min(phase.end * mean, channel.samples.size()));
    if (channel.high > channel.low) {
        const double margin = 1.001 * channel.lsb;
        const auto [lowest, highest] = extremesOf(first, last);
        return static_cast<double>(highest) >= channel.high - margin ||
               static_cast<double>(lowest) <= channel.low + margin;
    }
    if (!restless || phase.end - phase.begin < 10) return false;
    const float extreme = phase.sign > 0 ? recorded.highest : recorded.lowest;
    return 2 * std::count(first, last, extreme) > last - first;
}

/// True when neighbouring samples differ nearly always, so that a stretch of equal ones is no accident. Asked of a
/// hundred thousand pairs.
bool isRestless(std::span<const float> samples) {
    const std::size_t stride = std::max<std::size_t>(1, samples.size() / 100'000);
    std::size_t moves = 0;
    std::size_t pairs = 0;
    for (std::size_t i = 1; i < samples.size(); i += stride) {
        moves += samples[i] != samples[i - 1] ? 1 : 0;
        ++pairs;
    }
    return static_cast<double>(moves) > 0.6 * static_cast<double>(pairs);
}

/// Single samples beyond the threshold are noise where real phases are much larger.
void dropGlitches(std::vector<FoundPhase>& phases) {
    double largest[2] = {0, 0};
    for (const auto& phase : phases) {
        double& side = largest[phase.sign > 0 ? 1 : 0];
        side = std::max(side, phase.area);
    }
    std::erase_if(phases, [&](const FoundPhase& phase) {
        return phase.end - phase.begin < 3 && phase.area < 0.05 * largest[phase.sign > 0 ? 1 : 0];
    });
}

/// What lies beyond a phase's threshold and comes back from it, in the channel's unit.
struct Thresholds {
    float above = kNever;
    float below = -kNever;
    float aboveRelease = kNever;
    float belowRelease = -kNever;

    Thresholds(const StateLevels& levels, Sides sides) {
        const auto threshold = [&](double state) {
            const double distance = std::abs(state - levels.baseline);
            return std::min(0.5 * distance, std::max(kThreshold * distance, kThresholdInNoise * levels.noise));
        };
        if (levels.high > levels.baseline && sides != Sides::Down) {
            above = static_cast<float>(levels.baseline + threshold(levels.high));
            aboveRelease = static_cast<float>(levels.baseline + kRelease * threshold(levels.high));
        }
        if (levels.low < levels.baseline && sides != Sides::Up) {
            below = static_cast<float>(levels.baseline - threshold(levels.low));
            belowRelease = static_cast<float>(levels.baseline - kRelease * threshold(levels.low));
        }
    }
};

/// The phase that begins at sample `begin`: as far as the threshold is held.
FoundPhase follow(const SampleView& view, std::size_t begin, const Thresholds& thresholds, double baseline) {
    const auto samples = view.samples;
    FoundPhase phase;
    phase.view = &view;
    phase.begin = begin;
    phase.sign = samples[begin] > thresholds.above ? 1 : -1;
    const float sign = phase.sign > 0 ? 1.0F : -1.0F;
    const float release = sign * (phase.sign > 0 ? thresholds.aboveRelease : thresholds.belowRelease);
    double sum = 0;
    std::size_t missing = 0;
    std::size_t i = begin;
    for (; i < samples.size(); ++i) {
        const float x = sign * samples[i];
        if (x < release) break;
        // A missing sample does not end a phase; it makes it incomplete.
        if (std::isnan(x)) {
            ++missing;
        } else {
            sum += static_cast<double>(x);
        }
    }
    phase.incomplete = missing > 0;
    const double area = sum - phase.sign * baseline * static_cast<double>(i - begin - missing);
    phase.end = i;
    phase.area = area / view.rate_hz;
    phase.truncated = phase.begin == 0 || phase.end == samples.size();
    phase.incomplete = phase.incomplete || (begin > 0 && std::isnan(samples[begin - 1]));
    return phase;
}

}  // namespace

std::vector<FoundPhase> findPhases(const SampleView& view, const SampleBlocks& blocks, const StateLevels& levels,
                                   Sides sides) {
    const Thresholds thresholds(levels, sides);
    const std::size_t n = view.samples.size();
    std::vector<FoundPhase> phases;
    // Address space, not memory: what is not filled costs nothing, and what is filled is not copied as it grows.
    phases.reserve(std::min<std::size_t>(n / 20, 1'000'000));
    for (std::size_t i = 0; (i = blocks.nextBeyond(i, thresholds.below, thresholds.above)) < n;) {
        phases.push_back(follow(view, i, thresholds, levels.baseline));
        i = phases.back().end;
    }
    dropGlitches(phases);
    const bool rangeKnown = view.channel->high > view.channel->low;
    const bool restless = !rangeKnown && !phases.empty() && isRestless(view.channel->samples);
    Extremes recorded{blocks.lowest(), blocks.highest()};
    if (restless && !view.own.empty()) {
        const SampleBlocks asRecorded(view.channel->samples);
        recorded = {asRecorded.lowest(), asRecorded.highest()};
    }
    for (auto& phase : phases) {
        phase.clipped = isClipped(phase, restless, recorded);
        measureShape(phase, levels.baseline);
    }
    return phases;
}

void dropRinging(std::vector<FoundPhase>& phases) {
    const auto belongsTo = [](const FoundPhase& small, const FoundPhase& large, double apart_s, double within) {
        const double length_s = large.to_s() - large.from_s();
        const bool lower = std::abs(small.measured.plateau) < kLower * std::abs(large.measured.plateau);
        return apart_s <= within * length_s && small.to_s() - small.from_s() < 0.5 * length_s && lower &&
               small.area < kRinging * large.area;
    };
    std::size_t kept = 0;
    for (std::size_t k = 0; k < phases.size(); ++k) {
        if (kept > 0) {
            const auto& before = phases[kept - 1];
            if (belongsTo(phases[k], before, phases[k].from_s() - before.to_s(), kRingsFor)) continue;
        }
        if (k + 1 < phases.size() && phases[k].sign == phases[k + 1].sign) {
            const auto& after = phases[k + 1];
            if (belongsTo(phases[k], after, after.from_s() - phases[k].to_s(), kFlickersFor)) continue;
        }
        if (kept != k) phases[kept] = phases[k];
        ++kept;
    }
    phases.resize(kept);
}

void integratePhases(std::vector<FoundPhase>& phases, const StateLevels& levels) {
    const auto endOf = [](const FoundPhase& p) { return std::isfinite(p.end50) ? p.measured.end_s : p.to_s(); };
    const auto onsetOf = [](const FoundPhase& p) { return std::isfinite(p.onset) ? p.measured.onset_s : p.from_s(); };
    for (std::size_t k = 0; k < phases.size(); ++k) {
        auto& phase = phases[k];
        auto& m = phase.measured;
        if (m.samples == 0) continue;
        const auto& view = *phase.view;
        const double slowest = std::max({m.rise_s, m.fall_s, 0.0}) * view.rate_hz;
        double reach = (std::isfinite(slowest) ? 2.5 * slowest : 0) + 1;
        const double noise = levels.noise / std::abs(m.plateau);
        if (m.overshoot > std::max(kRings, kThresholdInNoise * noise)) {
            reach = std::max(reach, 0.5 * (phase.end50 - phase.onset));
        }
        double from = std::max(0.0, phase.onset - reach);
        double to = std::min(static_cast<double>(view.samples.size() - 1), phase.end50 + reach);
        if (k > 0) from = std::max(from, view.positionOf(0.5 * (endOf(phases[k - 1]) + m.onset_s)));
        if (k + 1 < phases.size()) to = std::min(to, view.positionOf(0.5 * (m.end_s + onsetOf(phases[k + 1]))));
        m.charge = phase.sign * integralOf(phase, levels.baseline, from, to) / view.rate_hz;
    }
}

}  // namespace tacto
