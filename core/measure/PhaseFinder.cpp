#include "core/measure/PhaseFinder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>

#include "core/measure/Clipping.h"

namespace tacto {

namespace {

// A record may hold 10 V and 40 V pulses: a phase begins well below half of the largest, and is then judged by its own
// plateau. Ringing stays below this share; noise stays below the multiple of its standard deviation.
constexpr double kThreshold = 0.15;
constexpr double kThresholdInNoise = 6;
constexpr double kRelease = 0.6;         // share of the threshold at which a phase ends (hysteresis)
constexpr double kReleaseInNoise = 4.5;  // times the noise, at least below the threshold: noise must not split a phase

constexpr std::size_t kHides = 3;  // missing samples in a row that may hide a phase; a shorter phase is a glitch

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Returns the threshold as a distance from the baseline. `distance`: from the baseline to the state.
double thresholdOf(double distance, double noise) {
    return std::min(0.5 * distance, std::max(kThreshold * distance, kThresholdInNoise * noise));
}

/// Drops single samples beyond the threshold: they are noise if real phases are much larger.
void dropGlitches(PhaseSpans& phases) {
    double largest[2] = {0, 0};
    for (const auto& phase : phases) {
        double& side = largest[phase.sign > 0 ? 1 : 0];
        side = std::max(side, phase.area);
    }
    std::erase_if(phases, [&](const PhaseSpan& phase) {
        return phase.end - phase.begin < 3 && phase.area < 0.05 * largest[phase.sign > 0 ? 1 : 0];
    });
}

/// Drops phases whose mean does not reach the threshold, if the noise sets the threshold.
void dropNoise(PhaseSpans& phases, const StateLevels& levels, double rate_hz) {
    std::erase_if(phases, [&](const PhaseSpan& phase) {
        const double distance = std::abs((phase.sign > 0 ? levels.high : levels.low) - levels.baseline);
        const double threshold = thresholdOf(distance, levels.noise);
        return threshold > kThreshold * distance &&
               phase.area * rate_hz < threshold * static_cast<double>(phase.end - phase.begin);
    });
}

/// A phase begins beyond its threshold and ends when the signal comes back; in the channel's unit.
struct Thresholds {
    float above = kInfinity;
    float below = -kInfinity;
    float aboveRelease = kInfinity;
    float belowRelease = -kInfinity;

    Thresholds(const StateLevels& levels, Sides sides) {
        const auto threshold = [&](double state) {
            return thresholdOf(std::abs(state - levels.baseline), levels.noise);
        };
        const auto release = [&](double from) {
            return std::max(0.0, std::min(kRelease * from, from - kReleaseInNoise * levels.noise));
        };
        if (levels.high > levels.baseline && sides != Sides::Down) {
            above = static_cast<float>(levels.baseline + threshold(levels.high));
            aboveRelease = static_cast<float>(levels.baseline + release(threshold(levels.high)));
        }
        if (levels.low < levels.baseline && sides != Sides::Up) {
            below = static_cast<float>(levels.baseline - threshold(levels.low));
            belowRelease = static_cast<float>(levels.baseline - release(threshold(levels.low)));
        }
    }
};

/// Samples examined together, so that a comparison or addition need not wait for the one before.
constexpr std::size_t kRow = 4;

/// Returns whether all samples of a row are present and above `release`.
bool holds(const float* row, float sign, float release) {
    std::int32_t odd = 0;
    for (std::size_t k = 0; k < kRow; ++k) odd |= sign * row[k] >= release ? 0 : 1;
    return odd == 0;
}

/// Fills in the phase that begins at sample `begin`; it lasts while the signal stays beyond the threshold.
void follow(const SampleView& view, std::size_t begin, const Thresholds& thresholds, double baseline,
            PhaseSpan& phase) {
    const auto samples = view.samples;
    phase.view = &view;
    phase.begin = begin;
    phase.sign = samples[begin] > thresholds.above ? 1 : -1;
    const float sign = phase.sign > 0 ? 1.0F : -1.0F;
    const float release = sign * (phase.sign > 0 ? thresholds.aboveRelease : thresholds.belowRelease);
    std::array<double, kRow> sums{};
    std::size_t missing = 0;
    std::size_t i = begin;
    while (i < samples.size()) {
        if (i + kRow <= samples.size() && holds(&samples[i], sign, release)) {
            for (std::size_t k = 0; k < kRow; ++k) sums[k] += static_cast<double>(sign * samples[i + k]);
            i += kRow;
            continue;
        }
        const float x = sign * samples[i];
        if (x < release) break;
        // A missing sample does not end a phase, but makes the phase incomplete.
        if (std::isnan(x)) {
            ++missing;
        } else {
            sums[0] += static_cast<double>(x);
        }
        ++i;
    }
    const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    phase.incomplete = missing > 0;
    const double area = sum - phase.sign * baseline * static_cast<double>(i - begin - missing);
    phase.end = i;
    phase.area = area / view.rate_hz;
    phase.truncated = phase.begin == 0 || phase.end == samples.size();
    phase.incomplete = phase.incomplete || (begin > 0 && std::isnan(samples[begin - 1]));
}

/// Marks missing samples between two phases, where another phase may lie. `from`: the end of the phase before, as far
/// as it is seen. Either phase may be null.
void markHidden(std::span<const float> samples, PhaseSpan* before, std::size_t from, PhaseSpan* after) {
    const std::size_t end = after == nullptr ? samples.size() : after->begin;
    for (std::size_t i = from; i < end; ++i) {
        const std::size_t first = i;
        while (i < end && std::isnan(samples[i])) ++i;
        if (i - first < kHides) continue;
        if (before != nullptr && !std::isfinite(before->hiddenAfter)) {
            before->hiddenAfter = static_cast<float>(first - from);
        }
        if (after == nullptr) return;
        after->hiddenBefore = static_cast<float>(end - i);
        after->hiddenFor = static_cast<float>(i - first);
    }
}

void markHidden(PhaseSpans& phases, std::span<const float> samples) {
    PhaseSpan* before = nullptr;
    std::size_t from = 0;
    for (auto& phase : phases) {
        markHidden(samples, before, from, &phase);
        before = &phase;
        from = phase.end;
        while (from > phase.begin && std::isnan(samples[from - 1])) --from;
    }
    if (before != nullptr) markHidden(samples, before, from, nullptr);
}

}  // namespace

PhaseSpans findPhases(const SampleView& view, const SampleBlocks& blocks, const StateLevels& levels, Sides sides) {
    const Thresholds thresholds(levels, sides);
    const std::size_t n = view.samples.size();
    PhaseSpans phases;
    for (std::size_t i = 0; (i = blocks.nextBeyond(i, thresholds.below, thresholds.above)) < n;) {
        auto& phase = phases.emplace_back();
        follow(view, i, thresholds, levels.baseline, phase);
        i = phase.end;
    }
    dropGlitches(phases);
    dropNoise(phases, levels, view.rate_hz);
    markClipped(phases, view, blocks);
    if (!blocks.complete()) markHidden(phases, view.samples);
    return phases;
}

}  // namespace tacto
