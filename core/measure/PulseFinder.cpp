#include "core/measure/PulseFinder.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

#include "core/measure/BaselineDrift.h"
#include "core/measure/ConverterStep.h"
#include "core/measure/PhaseFinder.h"
#include "core/measure/PulseAssembly.h"
#include "core/measure/PulseAttempt.h"

namespace tacto {

namespace {

constexpr double kReliable = 12;  // times the noise: distance from the baseline to a reliable state
constexpr double kSlack = 1.1;    // margin: averaging n samples divides white noise by √n, real noise by less
constexpr double kWhite = 1.4;    // times the noise that would remain if the noise were white
constexpr std::size_t kLongestMean = 4096;
constexpr double kSecondReliable = 6;  // times the noise: lower, because a second phase must follow a leading one
constexpr double kOtherSide = 0.15;    // share of the state: height of a phase on the other side
constexpr double kOtherSideInNoise = 4;
constexpr double kUnseenInSteps = 0.2;  // steps of the converter: less unrest is not reported
constexpr double kUnseen = 2e-4;        // share of the largest state: less unrest is not reported
constexpr double kDithers = 0.5;
constexpr double kMaxBeside = 0.07;  // share of the largest state: a higher level next to pulses is refused
constexpr double kMaxUnrest = 0.05;  // share of the distance to the nearest state; a phase begins at 0.09 to 0.15

/// Return how many times the noise the states are from the baseline: the further state; of three states, the nearer.
double strongOf(const StateLevels& levels) { return heightOf(levels) / levels.noise; }
double weakOf(const StateLevels& levels) {
    const double distance = std::min(distanceOf(levels.high, levels.baseline), distanceOf(levels.low, levels.baseline));
    return distance / levels.noise;
}
Sides strongSide(const StateLevels& levels) {
    const bool up = distanceOf(levels.high, levels.baseline) >= distanceOf(levels.low, levels.baseline);
    return up ? Sides::Up : Sides::Down;
}

/// Returns how many samples must be averaged to make a state reliable that is now `standsOut` times the noise.
std::size_t meanFor(double standsOut) {
    const double mean = std::ceil(kSlack * (kReliable / standsOut) * (kReliable / standsOut));
    return mean < static_cast<double>(kLongestMean) ? static_cast<std::size_t>(mean) : kLongestMean + 1;
}

class ChannelSearch {
public:
    ChannelSearch(const Capture& capture, double noise, double lsb, const MeasureOptions& options)
        : capture_(capture), noise_(noise), lsb_(lsb), gapMax_s_(options.interPhaseGapMax.count()) {}

    [[nodiscard]] PulseAttempt logic(const SampleView& view, const SampleBlocks& blocks) const {
        PulseAttempt attempt;
        attempt.levels = findStateLevels(blocks, 0, true);
        if (attempt.hasStates()) finish(findPhases(view, blocks, attempt.levels, Sides::Both), attempt);
        return attempt;
    }

    /// Returns the view of `base` with the least averaging that makes pulses reliable; `base` itself if there is none.
    [[nodiscard]] PulseAttempt best(const SampleView& base, const SampleBlocks& blocks) const {
        PulseAttempt plain = on(base, blocks);
        const double standsOut = strongOf(plain.levels);
        if (plain.hasStates() && standsOut >= kReliable) return complete(base, std::move(plain));
        std::size_t mean = plain.hasStates() ? std::max<std::size_t>(2, meanFor(standsOut)) : 4;
        // Each step tries a longer mean, except for one step back to the shortest reliable one.
        for (bool back = false; mean <= kLongestMean && base.samples.size() / mean >= 20;) {
            const auto view = averaged(base, mean);
            PulseAttempt attempt = on(view, SampleBlocks(view.samples));
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
        return judged(base, std::move(plain));
    }

private:
    [[nodiscard]] PulseAttempt complete(const SampleView& view, PulseAttempt found) const {
        return judged(view, withSecondSide(view, std::move(found)));
    }

    /// Flags incomplete pulses, and refuses pulses that do not rise from their baseline.
    [[nodiscard]] PulseAttempt judged(const SampleView& view, PulseAttempt whole) const {
        if (!whole.hasStates()) return whole;
        markCutPulses(view, whole);
        // The mean of a few samples still contains a slow baseline, so the noise is taken from neighbours' differences.
        lookBeside(view, whole, std::min(whole.levels.noise, kWhite * neighbourNoise(view.samples, lsbOf(view))));
        const double height = heightOf(whole.levels);
        // A second phase would be larger: the baseline itself has moved.
        if (std::abs(whole.levelAfter) < kMaxUnrest * height) {
            whole.beside = std::max(whole.beside, std::abs(whole.levelAfter));
        }
        double nearest = std::numeric_limits<double>::infinity();
        for (const double state : {whole.levels.low, whole.levels.high}) {
            if (state != whole.levels.baseline) nearest = std::min(nearest, distanceOf(state, whole.levels.baseline));
        }
        const auto refuse = [&](std::string why) {
            whole.levels.count = StateCount::None;
            whole.levels.why = std::move(why);
            whole.pulses.clear();
        };
        if (whole.unrest > kMaxUnrest * nearest) {
            refuse(fmt::format("its baseline moves by {:.2g} (s.d.), too much beside its pulses", whole.unrest));
        } else if (whole.beside > kMaxBeside * height) {
            refuse(fmt::format("just beside what may be pulses it lies {:.2g} from its baseline", whole.beside));
        } else if (const auto* wave = slowWave(whole)) {
            refuse(fmt::format("its baseline moves by {:.2g} within {:.2g} s, as far as a pulse",
                               std::abs(wave->plateau), wave->width_s));
        }
        return whole;
    }

    /// With two states only one side is known. If the record begins or ends on the other side, it cuts a phase that may
    /// belong to the pulse next to it.
    void markCutPulses(const SampleView& view, PulseAttempt& found) const {
        if (found.levels.count != StateCount::Two || found.pulses.empty()) return;
        const auto& levels = found.levels;
        const double state = levels.high > levels.baseline ? levels.high : levels.low;
        const double height = state - levels.baseline;
        const double least = std::max(kOtherSide * std::abs(height), kOtherSideInNoise * levels.noise);
        const auto liesThere = [&](float x) {
            return (levels.baseline - static_cast<double>(x)) * (height > 0 ? 1 : -1) > least;
        };
        const auto cut = [](PulseMeasurement& pulse) {
            const auto samples = pulse.leading.samples;
            pulse.flags.truncated = true;
            pulse.leading = {};
            pulse.leading.samples = samples;
        };
        auto& first = found.pulses.front();
        auto& last = found.pulses.back();
        const double end_s = view.timeOf(static_cast<double>(view.samples.size()));
        if (liesThere(view.samples.front()) && first.seenFrom_s - view.start_s <= gapMax_s_) cut(first);
        if (liesThere(view.samples.back()) && end_s - last.seenTo_s <= gapMax_s_) cut(last);
    }

    [[nodiscard]] double lsbOf(const SampleView& view) const {
        // Averaging can resolve less than one code only if the noise is half a step or more.
        return noise_ > kDithers * lsb_ ? lsb_ / std::sqrt(static_cast<double>(view.mean)) : lsb_;
    }

    /// Returns whether the noise is white. Averaging reveals pulses in white noise, but not in a signal that wanders.
    [[nodiscard]] bool isWhite(const SampleView& base, const PulseAttempt& attempt) const {
        const double share = std::sqrt(static_cast<double>(attempt.mean) / static_cast<double>(base.mean));
        const double noise = neighbourNoise(base.samples, lsbOf(base));
        return !(attempt.unrest > 0) && attempt.levels.noise <= kWhite * noise / share;
    }

    void finish(const PhaseSpans& phases, PulseAttempt& attempt) const {
        PulseAssembly assembly(capture_, attempt.levels, gapMax_s_, phases.size());
        for (const auto& phase : phases) assembly.add(phase);
        attempt.pulses = assembly.finish();
        attempt.widest_s = std::max(attempt.widest_s, assembly.widest_s());
        if (restsOnPlateaus(attempt.pulses)) return;
        attempt.levels = {};
        attempt.levels.why = "its edges fill its pulses, which have no plateau";
        attempt.pulses.clear();
    }

    [[nodiscard]] PulseAttempt on(const SampleView& view, const SampleBlocks& blocks) const {
        PulseAttempt attempt;
        attempt.mean = attempt.meanOfSecond = view.mean;
        attempt.levels = findStateLevels(blocks, lsbOf(view), false);
        if (!attempt.hasStates()) return attempt;
        attempt.secondStandsOut = weakOf(attempt.levels);
        attempt.unrest = unrestOf(view, attempt.levels, neighbourNoise(view.samples, lsbOf(view)));
        finish(findPhases(view, blocks, attempt.levels, Sides::Both), attempt);
        return attempt;
    }

    /// Looks for a shallow second phase on longer means, and measures it there. Without averaging it may be lost in
    /// noise from which the leading phase stands out, and then be taken for the baseline.
    [[nodiscard]] PulseAttempt withSecondSide(const SampleView& view, PulseAttempt found) const {
        const bool three = found.levels.count == StateCount::Three;
        if (three && weakOf(found.levels) >= kReliable) return found;
        if (three) {
            found.secondStandsOut = weakOf(found.levels);
        } else {
            const auto hidden = levelAfter(view, found, gapMax_s_);
            if (!hidden) return found;
            found.levelAfter = hidden->difference;
            found.levelBefore = hidden->before;
        }
        for (std::size_t mean = 4; mean <= kLongestMean && view.samples.size() / mean >= 20; mean *= 4) {
            if (auto both = onTwoMeans(view, averaged(view, mean), found)) return *std::move(both);
        }
        if (three) return found;
        // The second phase stays hidden, but the baseline is the level before the pulses.
        const SampleBlocks blocks(view.samples);
        const bool up = strongSide(found.levels) == Sides::Up;
        found.levels.baseline = found.levelBefore;
        (up ? found.levels.low : found.levels.high) = found.levelBefore;
        found.unrest = 0;
        finish(findPhases(view, blocks, found.levels, Sides::Both), found);
        return found;
    }

    /// Finds the leading side on `view`, the other on `slow`. Returns nothing if `slow` lacks most second phases.
    [[nodiscard]] std::optional<PulseAttempt> onTwoMeans(const SampleView& view, const SampleView& slow,
                                                         const PulseAttempt& found) const {
        const SampleBlocks blocks(slow.samples);
        const auto levels = findStateLevels(blocks, lsbOf(slow), false);
        if (levels.count != StateCount::Three || !(weakOf(levels) >= kSecondReliable)) return std::nullopt;
        PulseAttempt both = found;
        both.levelAfter = 0;
        both.levels = levels;
        both.levels.noise = found.levels.noise;
        both.meanOfSecond = slow.mean;
        both.secondStandsOut = weakOf(levels);
        both.unrest = unrestOf(slow, levels, neighbourNoise(slow.samples, lsbOf(slow)));
        const Sides strong = strongSide(found.levels);
        const double state = strong == Sides::Up ? found.levels.high : found.levels.low;
        // The state of the leading side comes from the less averaged view.
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

    const Capture& capture_;
    double noise_;
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
    PulseAttempt attempt;
    auto recorded = asRecorded(capture, channel);
    SampleBlocks blocks(recorded.samples);
    const double noise = logic ? 0 : neighbourNoise(recorded.samples, lsb);
    const ChannelSearch search(capture, noise, lsb, options);
    if (!logic) {
        const auto leaps = leapingSamples(blocks, noise, lsb);
        found.quality.leaps = leaps.size();
        if (!leaps.empty()) {
            recorded = withoutLeaps(recorded, leaps);
            blocks = SampleBlocks(recorded.samples);
        }
    }
    const auto drift = logic ? std::nullopt : findDrift(recorded.samples, noise, lsb);
    if (drift) {
        const auto still = withoutDrift(recorded, *drift);
        attempt = search.best(still, SampleBlocks(still.samples));
        // A phase of half a block's length moves the median: the supposed drift was pulses.
        const double block_s = static_cast<double>(drift->block) / capture.rate_hz;
        if (attempt.hasStates() && !attempt.pulses.empty() && attempt.widest_s <= 0.5 * block_s) {
            found.quality.drift = drift->span;
        } else {
            attempt = {};
        }
    }
    if (!(found.quality.drift > 0)) attempt = logic ? search.logic(recorded, blocks) : search.best(recorded, blocks);
    found.levels = std::move(attempt.levels);
    found.pulses = std::move(attempt.pulses);
    found.quality.mean = attempt.mean;
    found.quality.meanOfSecond = attempt.meanOfSecond;
    if (found.levels.count == StateCount::None) return found;
    const bool biphasic = found.levels.count == StateCount::Three;
    const double standsOut = strongOf(found.levels);
    found.quality.snr_db = 20 * std::log10(standsOut);
    found.quality.doubtful = standsOut < kReliable || (biphasic && attempt.secondStandsOut < kSecondReliable);
    // If second phases may be missed, a pulse without a second phase may still have one.
    for (auto& pulse : found.pulses) {
        if (found.quality.doubtful && !pulse.second) pulse.imbalance = kNotMeasured;
    }
    found.quality.unrest = attempt.unrest;
    // As a standard deviation for each pulse: the largest deviation is at most two of these.
    const double beside = std::max(attempt.beside, 0.5 * attempt.mostBeside);
    if (beside > std::max(kUnseenInSteps * lsb, kUnseen * heightOf(found.levels))) {
        found.quality.unrest = std::max(attempt.unrest, beside);
    }
    found.quality.levelAfter = attempt.levelAfter;
    return found;
}

}  // namespace tacto
