#include "core/measure/PulseFinder.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

#include "core/base/Statistics.h"
#include "core/measure/BaselineDrift.h"
#include "core/measure/ConverterStep.h"
#include "core/measure/LeapingSamples.h"
#include "core/measure/PhaseFinder.h"
#include "core/measure/PulseAssembly.h"

namespace tacto {

namespace {

constexpr double kReliable = 12;  // times the noise, from the baseline to a state
constexpr double kSlack = 1.1;    // white noise falls by the root of the mean's length, real noise by less
constexpr double kWhite = 1.4;    // times what averaging leaves of white noise
constexpr std::size_t kLongestMean = 4096;
constexpr double kShallowest = 0.02;   // of the leading phase: less beyond the other side is not a second phase
constexpr double kSecondReliable = 6;  // times the noise: that it follows a leading phase is known besides
constexpr std::size_t kJudgedPulses = 1000;
constexpr double kMostUnrest = 0.06;  // of the way to the nearest state: a phase begins at 0.09 to 0.15
constexpr double kMostlyEdges = 0.6;  // of the width: half a sine has 0.67

double distanceOf(double state, double baseline) { return std::isfinite(state) ? std::abs(state - baseline) : 0; }

/// How far the larger state stands out of the noise; and the smaller, of three.
double strongOf(const StateLevels& levels) {
    const double distance = std::max(distanceOf(levels.high, levels.baseline), distanceOf(levels.low, levels.baseline));
    return distance / levels.noise;
}
double weakOf(const StateLevels& levels) {
    const double distance = std::min(distanceOf(levels.high, levels.baseline), distanceOf(levels.low, levels.baseline));
    return distance / levels.noise;
}
Sides strongSide(const StateLevels& levels) {
    const bool up = distanceOf(levels.high, levels.baseline) >= distanceOf(levels.low, levels.baseline);
    return up ? Sides::Up : Sides::Down;
}

/// How many samples of a view must become one for a state `standsOut` times the noise to be reliable.
std::size_t meanFor(double standsOut) {
    const double mean = std::ceil(kSlack * (kReliable / standsOut) * (kReliable / standsOut));
    return mean < static_cast<double>(kLongestMean) ? static_cast<std::size_t>(mean) : kLongestMean + 1;
}

/// How far the baseline moves by more than its noise: two thirds of the samples about it are within this. 0 if that is
/// the noise, or less than a fiftieth of the pulses.
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

/// A signal whose edges fill its pulses (a sine, a triangle) has no states, whatever its histogram says.
bool restsOnPlateaus(const std::vector<PulseMeasurement>& pulses) {
    std::vector<double> edgeShares;
    const std::size_t stride = std::max<std::size_t>(1, pulses.size() / kJudgedPulses);
    for (std::size_t k = 0; k < pulses.size(); k += stride) {
        const auto& m = pulses[k].leading;
        const double share = (m.rise_s + m.fall_s) / m.width_s;
        if (std::isfinite(share)) edgeShares.push_back(share);
    }
    return edgeShares.empty() || statisticsOf(edgeShares).median <= kMostlyEdges;
}

/// One way to look at the channel and what it shows.
struct Attempt {
    StateLevels levels;
    std::vector<PulseMeasurement> pulses;
    std::size_t mean = 1;
    std::size_t meanOfSecond = 1;
    double widest_s = 0;         // phase
    double secondStandsOut = 0;  // in its own view, where there are three states
    double unrest = 0;           // see SignalQuality
    double levelAfter = 0;       // the same
    double levelBefore = 0;
    double beside = 0;  ///< see SignalQuality

    [[nodiscard]] bool hasStates() const noexcept { return levels.count != StateCount::None; }
    [[nodiscard]] bool mostlyMeasured() const {
        const auto n = std::count_if(pulses.begin(), pulses.end(), [](const auto& p) { return p.flags.measured(); });
        return n > 0 && 2 * static_cast<std::size_t>(n) >= pulses.size();
    }
    [[nodiscard]] bool mostlyPaired() const {
        const auto n = std::count_if(pulses.begin(), pulses.end(),
                                     [](const auto& p) { return p.second.has_value() || !p.flags.measured(); });
        return n > 0 && 2 * static_cast<std::size_t>(n) >= pulses.size();
    }
};

class ChannelSearch {
public:
    ChannelSearch(const Capture& capture, const CaptureChannel& channel, double lsb, const MeasureOptions& options)
        : capture_(capture), channel_(channel), lsb_(lsb), gapMax_s_(options.interPhaseGapMax.count()) {}

    [[nodiscard]] Attempt logic() const {
        const auto view = asRecorded(capture_, channel_);
        const SampleBlocks blocks(view.samples);
        Attempt attempt;
        attempt.levels = findStateLevels(blocks, 0, true);
        if (attempt.hasStates()) finish(findPhases(view, blocks, attempt.levels, Sides::Both), attempt);
        return attempt;
    }

    /// The least averaged view of `base` in which pulses are reliable; `base` itself where there is none.
    [[nodiscard]] Attempt best(const SampleView& base) const {
        Attempt plain = on(base);
        const double standsOut = strongOf(plain.levels);
        if (plain.hasStates() && standsOut >= kReliable) return complete(base, std::move(plain));
        std::size_t mean = plain.hasStates() ? std::max<std::size_t>(2, meanFor(standsOut)) : 4;
        // Each step goes to a longer mean, but for one step back to the shortest that is reliable.
        for (bool back = false; mean <= kLongestMean && base.samples.size() / mean >= 20;) {
            const auto view = averaged(base, mean);
            Attempt attempt = on(view);
            const double nowOut = strongOf(attempt.levels);
            if (!attempt.hasStates()) {
                if (back) break;
                mean *= 4;
                continue;
            }
            const double share = kSlack * (kReliable / nowOut) * (kReliable / nowOut) * static_cast<double>(mean);
            const auto enough =
                static_cast<std::size_t>(std::clamp(std::ceil(share), 2.0, static_cast<double>(kLongestMean + 1)));
            if (nowOut < kReliable) {
                if (back) break;
                mean = std::max(enough, mean + 1);
                continue;
            }
            if (!isWhite(base, attempt)) break;
            if (attempt.mostlyMeasured()) return complete(view, std::move(attempt));
            if (back || enough >= mean) break;
            mean = enough;
            back = true;
        }
        plain.beside = levelBeside(base, plain);
        return plain;
    }

private:
    [[nodiscard]] Attempt complete(const SampleView& view, Attempt found) const {
        auto whole = withSecondSide(view, std::move(found));
        whole.beside = levelBeside(view, whole);
        double nearest = std::numeric_limits<double>::infinity();
        for (const double state : {whole.levels.low, whole.levels.high}) {
            if (state != whole.levels.baseline) nearest = std::min(nearest, distanceOf(state, whole.levels.baseline));
        }
        if (whole.unrest > kMostUnrest * nearest) {
            whole.levels.why =
                fmt::format("its baseline moves by {:.2g} (s.d.), too much beside its pulses", whole.unrest);
            whole.levels.count = StateCount::None;
            whole.pulses.clear();
        }
        return whole;
    }

    [[nodiscard]] double lsbOf(const SampleView& view) const {
        return lsb_ / std::sqrt(static_cast<double>(view.mean));
    }

    /// Averaging shows pulses in white noise. In what wanders it shows whatever is there at the time.
    [[nodiscard]] bool isWhite(const SampleView& base, const Attempt& attempt) const {
        const double share = std::sqrt(static_cast<double>(attempt.mean) / static_cast<double>(base.mean));
        const double noise = neighbourNoise(base.samples, lsbOf(base));
        return !(attempt.unrest > 0) && attempt.levels.noise <= kWhite * noise / share;
    }

    void finish(const PhaseSpans& phases, Attempt& attempt) const {
        PulseAssembly assembly(capture_, attempt.levels, gapMax_s_, phases.size());
        for (const auto& phase : phases) assembly.add(phase);
        attempt.pulses = assembly.finish();
        attempt.widest_s = std::max(attempt.widest_s, assembly.widest_s());
        if (restsOnPlateaus(attempt.pulses)) return;
        attempt.levels = {};
        attempt.levels.why = "its edges fill its pulses, which have no plateau";
        attempt.pulses.clear();
    }

    [[nodiscard]] Attempt on(const SampleView& view) const {
        const SampleBlocks blocks(view.samples);
        Attempt attempt;
        attempt.mean = attempt.meanOfSecond = view.mean;
        attempt.levels = findStateLevels(blocks, lsbOf(view), false);
        if (!attempt.hasStates()) return attempt;
        attempt.secondStandsOut = weakOf(attempt.levels);
        attempt.unrest = unrestOf(view, attempt.levels, neighbourNoise(view.samples, lsbOf(view)));
        finish(findPhases(view, blocks, attempt.levels, Sides::Both), attempt);
        return attempt;
    }

    /// A second phase that is shallow may be lost in noise from which the leading one stands out, and then be taken for
    /// the baseline. It is looked for on longer means, and measured there.
    [[nodiscard]] Attempt withSecondSide(const SampleView& view, Attempt found) const {
        const bool three = found.levels.count == StateCount::Three;
        if (three && weakOf(found.levels) >= kReliable) return found;
        if (three) {
            found.secondStandsOut = weakOf(found.levels);
        } else {
            const auto hidden = levelAfter(view, found);
            if (!hidden) return found;
            found.levelAfter = hidden->difference;
            found.levelBefore = hidden->before;
        }
        for (std::size_t mean = 4; mean <= kLongestMean && view.samples.size() / mean >= 20; mean *= 4) {
            if (auto both = onTwoMeans(view, averaged(view, mean), found)) return *std::move(both);
        }
        if (three) return found;
        // It stays hidden; but the baseline is where the signal is before its pulses.
        const SampleBlocks blocks(view.samples);
        const bool up = strongSide(found.levels) == Sides::Up;
        found.levels.baseline = found.levelBefore;
        (up ? found.levels.low : found.levels.high) = found.levelBefore;
        found.unrest = 0;
        finish(findPhases(view, blocks, found.levels, Sides::Both), found);
        return found;
    }

    /// The leading side on `view`, the other on `slow`; none if `slow` does not show a second phase for most pulses.
    [[nodiscard]] std::optional<Attempt> onTwoMeans(const SampleView& view, const SampleView& slow,
                                                    const Attempt& found) const {
        const SampleBlocks blocks(slow.samples);
        const auto levels = findStateLevels(blocks, lsbOf(slow), false);
        if (levels.count != StateCount::Three || !(weakOf(levels) >= kSecondReliable)) return std::nullopt;
        Attempt both = found;
        both.levelAfter = 0;
        both.levels = levels;
        both.levels.noise = found.levels.noise;
        both.meanOfSecond = slow.mean;
        both.secondStandsOut = weakOf(levels);
        both.unrest = unrestOf(slow, levels, neighbourNoise(slow.samples, lsbOf(slow)));
        const Sides strong = strongSide(found.levels);
        const double state = strong == Sides::Up ? found.levels.high : found.levels.low;
        // The leading side's state is the sharper view's.
        (strong == Sides::Up ? both.levels.high : both.levels.low) = state;
        auto phases = findPhases(view, SampleBlocks(view.samples), both.levels, strong);
        const auto slowPhases = findPhases(slow, blocks, levels, strong == Sides::Up ? Sides::Down : Sides::Up);
        phases.insert(phases.end(), slowPhases.begin(), slowPhases.end());
        std::stable_sort(phases.begin(), phases.end(),
                         [](const PhaseSpan& a, const PhaseSpan& b) { return a.from_s() < b.from_s(); });
        finish(phases, both);
        if (!both.hasStates() || !both.mostlyPaired()) return std::nullopt;
        return both;
    }

    struct Silence {
        double sum = 0, n = 0;
        [[nodiscard]] double mean() const noexcept { return sum / n; }
    };

    /// From the baseline, within the silence before and after pulse k: up to two of its widths, half a width from it.
    /// Where the silence is short, its middle half.
    [[nodiscard]] static std::pair<Silence, Silence> silencesBeside(const SampleView& view, const Attempt& found,
                                                                    std::size_t k) {
        constexpr double kFrom = 0.5, kTo = 2.5;
        const auto last = static_cast<double>(view.samples.size());
        const auto sumOf = [&](double from, double to) {
            Silence silence;
            const auto end = static_cast<std::size_t>(std::clamp(to, 0.0, last));
            for (auto i = static_cast<std::size_t>(std::clamp(from, 0.0, last)); i < end; ++i) {
                const double x = static_cast<double>(view.samples[i]) - found.levels.baseline;
                if (std::isnan(x)) continue;
                silence.sum += x;
                silence.n += 1;
            }
            return silence;
        };
        const auto& p = found.pulses[k];
        const double width = p.leading.width_s * view.rate_hz;
        const double onset = view.positionOf(p.leading.onset_s);
        const double end = view.positionOf(p.second ? p.second->end_s : p.leading.end_s);
        const double previous = k == 0 ? 0 : view.positionOf(found.pulses[k - 1].seenTo_s);
        const double next = k + 1 == found.pulses.size() ? last : view.positionOf(found.pulses[k + 1].seenFrom_s);
        const double before = onset - previous, after = next - end;
        return {sumOf(std::max(onset - kTo * width, previous + (k == 0 ? 0 : 0.25 * before)),
                      onset - std::min(kFrom * width, 0.25 * before)),
                sumOf(end + std::min(kFrom * width, 0.25 * after),
                      std::min(end + kTo * width, next - (next < last ? 0.25 * after : 0)))};
    }

    struct AfterPulses {
        double difference = 0;  // after less before
        double before = 0;
    };

    /// The level just after pulses against that just before them, where the difference goes against the pulses and is
    /// no noise: five standard deviations of the means.
    [[nodiscard]] static std::optional<AfterPulses> levelAfter(const SampleView& view, const Attempt& found) {
        Silence before, after;
        double amplitude = 0;
        const std::size_t stride = std::max<std::size_t>(1, found.pulses.size() / kJudgedPulses);
        for (std::size_t k = 0; k < found.pulses.size(); k += stride) {
            if (!found.pulses[k].flags.measured()) continue;
            const auto [left, right] = silencesBeside(view, found, k);
            before.sum += left.sum;
            before.n += left.n;
            after.sum += right.sum;
            after.n += right.n;
            amplitude = found.pulses[k].leading.plateau;
        }
        if (!(after.n > 0)) return std::nullopt;
        if (!(before.n > 0))
            before.n = std::numeric_limits<double>::infinity();  // the record begins too late: the baseline
        const double difference = after.mean() - before.mean();
        const double noise = found.levels.noise * std::sqrt(1 / before.n + 1 / after.n);
        if (!(difference * amplitude < 0) || !(std::abs(difference) > 5 * noise) ||
            !(std::abs(difference) > kShallowest * std::abs(amplitude))) {
            return std::nullopt;
        }
        return AfterPulses{difference, found.levels.baseline + before.mean()};
    }

    /// How far the signal lies from the baseline just beside its pulses: RMS over pulses of the larger side.
    [[nodiscard]] static double levelBeside(const SampleView& view, const Attempt& found) {
        double squares = 0, n = 0;
        const std::size_t stride = std::max<std::size_t>(1, found.pulses.size() / kJudgedPulses);
        for (std::size_t k = 0; k < found.pulses.size(); k += stride) {
            if (!found.pulses[k].flags.measured()) continue;
            const auto [left, right] = silencesBeside(view, found, k);
            double largest = 0;
            for (const auto& silence : {left, right}) {
                if (silence.n > 0) largest = std::max(largest, std::abs(silence.mean()));
            }
            squares += largest * largest;
            n += 1;
        }
        return n > 0 ? std::sqrt(squares / n) : 0;
    }

    const Capture& capture_;
    const CaptureChannel& channel_;
    double lsb_;
    double gapMax_s_;
};

}  // namespace

FoundPulses findPulses(const Capture& capture, const CaptureChannel& channel, const MeasureOptions& options) {
    FoundPulses found;
    const bool logic = channel.unit.empty() && std::all_of(channel.samples.begin(), channel.samples.end(),
                                                           [](float x) { return x == 0.0F || x == 1.0F; });
    if (!logic && !(channel.lsb > 0)) found.quality.foundStep = converterStep(channel.samples);
    const double lsb = channel.lsb > 0 ? channel.lsb : found.quality.foundStep;
    if (!(capture.rate_hz > 0)) {
        found.levels = findStateLevels(channel.samples, lsb, logic);
        if (found.levels.count == StateCount::None) return found;
        found.levels = {};
        found.levels.why = "its sampling rate is unknown";
        return found;
    }
    Attempt attempt;
    const ChannelSearch search(capture, channel, lsb, options);
    auto recorded = asRecorded(capture, channel);
    const double noise = logic ? 0 : neighbourNoise(recorded.samples, lsb);
    if (!logic) {
        const auto leaps = leapingSamples(SampleBlocks(recorded.samples), noise, lsb);
        if (!leaps.empty()) recorded = withoutLeaps(recorded, leaps);
        found.quality.leaps = leaps.size();
    }
    const auto drift = logic ? std::nullopt : findDrift(recorded.samples, noise, lsb);
    if (drift) {
        attempt = search.best(withoutDrift(recorded, *drift));
        // A phase of half a block's length moves its median: what was taken for drift was pulses.
        const double block_s = static_cast<double>(drift->block) / capture.rate_hz;
        if (attempt.hasStates() && !attempt.pulses.empty() && attempt.widest_s <= 0.5 * block_s) {
            found.quality.drift = drift->span;
        } else {
            attempt = {};
        }
    }
    if (!(found.quality.drift > 0)) attempt = logic ? search.logic() : search.best(recorded);
    found.levels = std::move(attempt.levels);
    found.pulses = std::move(attempt.pulses);
    found.quality.mean = attempt.mean;
    found.quality.meanOfSecond = attempt.meanOfSecond;
    if (found.levels.count == StateCount::None) return found;
    const bool biphasic = found.levels.count == StateCount::Three;
    const double standsOut = strongOf(found.levels);
    found.quality.snr_db = 20 * std::log10(standsOut);
    found.quality.doubtful = standsOut < kReliable || (biphasic && attempt.secondStandsOut < kSecondReliable);
    found.quality.unrest = attempt.unrest;
    found.quality.beside = attempt.beside;
    found.quality.levelAfter = attempt.levelAfter;
    return found;
}

}  // namespace tacto
