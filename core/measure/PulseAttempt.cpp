#include "core/measure/PulseAttempt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/Statistics.h"

namespace tacto {

namespace {

constexpr double kShallowest = 0.02;  // share of the leading phase: a smaller one is not a second phase
constexpr std::size_t kJudgedPulses = 1000;
constexpr double kNoNoise = 4.5;   // standard deviations of a mean: a higher level is not noise
constexpr double kMaxEdges = 0.6;  // share of the width; half a sine has 0.67
// Thresholds for an apparent pulse that is really a slow wave of the baseline:
constexpr double kTall = 0.5;       // share of the largest state: certainly a pulse
constexpr double kLow = 0.4;        // share of the largest state: a wave is lower
constexpr double kLong = 3;         // times the width of the widest certain pulse
constexpr double kSlowEdges = 0.4;  // share of the width: the edges of a wave last longer
constexpr double kPeak = 2;         // overshoot of a wave that begins as a pulse and stays beyond the threshold

struct Silence {
    double sum = 0, n = 0;
    [[nodiscard]] double mean() const noexcept { return sum / n; }
    void add(const Silence& other) noexcept {
        sum += other.sum;
        n += other.n;
    }
};

/// Collects the samples between two positions, measured from the baseline.
Silence silence(const SampleView& view, const PulseAttempt& found, double from, double to) {
    Silence result;
    const auto last = static_cast<double>(view.samples.size());
    const auto end = static_cast<std::size_t>(std::clamp(to, 0.0, last));
    for (auto i = static_cast<std::size_t>(std::clamp(from, 0.0, last)); i < end; ++i) {
        const double x = static_cast<double>(view.samples[i]) - found.levels.baseline;
        if (std::isnan(x)) continue;
        result.sum += x;
        result.n += 1;
    }
    return result;
}

/// Positions of a pulse and of the silence around it.
struct PulsePlace {
    double width, onset, end;
    double silentFrom, silentTo;
    bool first, last;

    PulsePlace(const SampleView& view, const PulseAttempt& found, std::size_t k)
        : first(k == 0), last(k + 1 == found.pulses.size()) {
        const auto& p = found.pulses[k];
        width = p.leading.width_s * view.rate_hz;
        onset = view.positionOf(p.leading.onset_s);
        end = view.positionOf(p.seenTo_s);
        silentFrom = first ? 0 : view.positionOf(found.pulses[k - 1].seenTo_s);
        silentTo = last ? static_cast<double>(view.samples.size()) : view.positionOf(found.pulses[k + 1].seenFrom_s);
    }
};
constexpr double kSilentFrom = 0.5, kSilentTo = 2.5;  // distances from a pulse, in widths

/// Returns up to two widths of silence, ending half a width before the pulse; of a short silence, its middle half.
Silence silenceBefore(const SampleView& view, const PulseAttempt& found, const PulsePlace& p) {
    const double quarter = 0.25 * (p.onset - p.silentFrom);
    return silence(view, found, std::max(p.onset - kSilentTo * p.width, p.silentFrom + (p.first ? 0 : quarter)),
                   p.onset - std::min(kSilentFrom * p.width, quarter));
}
/// Returns the silence after the pulse, or a stretch `later` times two widths further on.
Silence silenceAfter(const SampleView& view, const PulseAttempt& found, const PulsePlace& p, std::size_t later = 0) {
    const double quarter = 0.25 * (p.silentTo - p.end);
    const double shift = static_cast<double>(later) * (kSilentTo - kSilentFrom) * p.width;
    return silence(view, found, p.end + shift + std::min(kSilentFrom * p.width, quarter),
                   std::min(p.end + shift + kSilentTo * p.width, p.silentTo - (p.last ? 0 : quarter)));
}

/// Calls `look` for an evenly spaced selection of the pulses.
template <class Look>
void lookAtPulses(const PulseAttempt& found, Look look) {
    const std::size_t stride = std::max<std::size_t>(1, found.pulses.size() / kJudgedPulses);
    for (std::size_t k = 0; k < found.pulses.size(); k += stride) {
        if (found.pulses[k].flags.measured()) look(k);
    }
}

}  // namespace

double distanceOf(double state, double baseline) { return std::isfinite(state) ? std::abs(state - baseline) : 0; }

double heightOf(const StateLevels& levels) {
    return std::max(distanceOf(levels.high, levels.baseline), distanceOf(levels.low, levels.baseline));
}

double unrestOf(const SampleView& view, const StateLevels& levels, double noise) {
    constexpr std::size_t kJudgedSamples = 32'768;
    double nearest = std::numeric_limits<double>::infinity();
    for (const double state : {levels.low, levels.high}) {
        if (state != levels.baseline) nearest = std::min(nearest, std::abs(state - levels.baseline));
    }
    std::vector<double> distances;
    const std::size_t stride = std::max<std::size_t>(1, view.samples.size() / kJudgedSamples);
    distances.reserve(view.samples.size() / stride + 1);
    for (std::size_t i = 0; i < view.samples.size(); i += stride) {
        const double distance = std::abs(static_cast<double>(view.samples[i]) - levels.baseline);
        if (distance < 0.5 * nearest) distances.push_back(distance);
    }
    if (distances.empty()) return 0;
    const auto at = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 2 / 3);
    std::nth_element(distances.begin(), at, distances.end());
    return *at > 1.5 * noise && *at > 0.02 * nearest ? *at : 0;
}

bool restsOnPlateaus(const std::vector<PulseMeasurement>& pulses) {
    std::vector<double> edgeShares;
    const std::size_t stride = std::max<std::size_t>(1, pulses.size() / kJudgedPulses);
    for (std::size_t k = 0; k < pulses.size(); k += stride) {
        const auto& m = pulses[k].leading;
        const double share = (m.rise_s + m.fall_s) / m.width_s;
        if (std::isfinite(share)) edgeShares.push_back(share);
    }
    return edgeShares.empty() || statisticsOf(edgeShares).median <= kMaxEdges;
}

const PhaseMeasurement* slowWave(const PulseAttempt& found) {
    const double height = heightOf(found.levels);
    double widest_s = 0;
    lookAtPulses(found, [&](std::size_t k) {
        const auto& m = found.pulses[k].leading;
        if (std::abs(m.plateau) > kTall * height) widest_s = std::max(widest_s, m.width_s);
    });
    if (!(widest_s > 0) || !(found.widest_s > kLong * widest_s)) return nullptr;
    const auto wave = std::ranges::find_if(found.pulses, [&](const PulseMeasurement& pulse) {
        const auto& m = pulse.leading;
        return std::abs(m.plateau) < kLow * height && m.width_s > kLong * widest_s &&
               (m.rise_s + m.fall_s > kSlowEdges * m.width_s || m.overshoot > kPeak);
    });
    return wave == found.pulses.end() ? nullptr : &wave->leading;
}

std::optional<AfterPulses> levelAfter(const SampleView& view, const PulseAttempt& found, double within_s) {
    constexpr std::size_t kWindows = 8;
    Silence ahead;
    std::array<Silence, kWindows> behind{};
    double amplitude = 0;
    lookAtPulses(found, [&](std::size_t k) {
        const PulsePlace place(view, found, k);
        ahead.add(silenceBefore(view, found, place));
        for (std::size_t later = 0; later < kWindows; ++later) {
            if (later > 0 && static_cast<double>(later) * 2 * place.width > within_s * view.rate_hz) break;
            behind[later].add(silenceAfter(view, found, place, later));
        }
        amplitude = found.pulses[k].leading.plateau;
    });
    // If a record begins too late to show the level before its pulses, the baseline is used instead.
    const double level = ahead.n > 0 ? ahead.mean() : 0;
    std::optional<AfterPulses> most;
    for (const auto& one : behind) {
        if (!(one.n > 0)) continue;
        const double difference = one.mean() - level;
        const double noise = found.levels.noise * std::sqrt((ahead.n > 0 ? 1 / ahead.n : 0) + 1 / one.n);
        if (!(difference * amplitude < 0) || !(std::abs(difference) > 5 * noise) ||
            !(std::abs(difference) > kShallowest * std::abs(amplitude))) {
            continue;
        }
        if (most && std::abs(most->difference) >= std::abs(difference)) continue;
        most = AfterPulses{difference, found.levels.baseline + level};
    }
    return most;
}

void lookBeside(const SampleView& view, PulseAttempt& found, double noise) {
    double squares = 0, n = 0;
    lookAtPulses(found, [&](std::size_t k) {
        const PulsePlace place(view, found, k);
        double largest = 0;
        const bool hidden = found.levelAfter != 0;  // a level after the pulses was found before
        for (const auto& one :
             {silenceBefore(view, found, place), hidden ? Silence{} : silenceAfter(view, found, place)}) {
            const double level = one.n > 0 ? std::abs(one.mean()) : 0;
            if (level > kNoNoise * noise / std::sqrt(one.n)) largest = std::max(largest, level);
        }
        found.mostBeside = std::max(found.mostBeside, largest);
        squares += largest * largest;
        n += 1;
    });
    found.beside = n > 0 ? std::sqrt(squares / n) : 0;
}

}  // namespace tacto
