#include "core/measure/PulseFinder.h"

#include <algorithm>
#include <array>
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
constexpr double kShallowest = 0.02;   // share of the leading phase: less beyond the other side is not a second phase
constexpr double kSecondReliable = 6;  // times the noise: that it follows a leading phase is known besides
constexpr std::size_t kJudgedPulses = 1000;
constexpr double kOtherSide = 0.15;  // share of the state: a phase on the other side
constexpr double kOtherSideInNoise = 4;
constexpr double kNoNoise = 4.5;        // standard deviations of a mean
constexpr double kUnseenInSteps = 0.2;  // steps of the converter
constexpr double kUnseen = 2e-4;        // share of the largest state
constexpr double kDithers = 0.5;
constexpr double kMaxBeside = 0.07;  // share of the largest state
constexpr double kMaxUnrest = 0.05;  // share of the way to the nearest state: a phase begins at 0.09 to 0.15
constexpr double kMaxEdges = 0.6;    // share of the width: half a sine has 0.67
// What may be a pulse and is the baseline's own slow wave:
constexpr double kTall = 0.5;       // share of the largest state: surely a pulse
constexpr double kLow = 0.4;        // share of the largest state
constexpr double kLong = 3;         // times the widest that surely is one
constexpr double kSlowEdges = 0.4;  // share of its width
constexpr double kPeak = 2;         // overshoot: it begins as a pulse and stays beyond the threshold

double distanceOf(double state, double baseline) { return std::isfinite(state) ? std::abs(state - baseline) : 0; }

/// From the baseline to the state that is further away.
double heightOf(const StateLevels& levels) {
    return std::max(distanceOf(levels.high, levels.baseline), distanceOf(levels.low, levels.baseline));
}
/// How far the larger state stands out of the noise; and the smaller, of three.
double strongOf(const StateLevels& levels) { return heightOf(levels) / levels.noise; }
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
    return edgeShares.empty() || statisticsOf(edgeShares).median <= kMaxEdges;
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
    double levelAfter = 0;       // as SignalQuality::levelAfter
    double levelBefore = 0;
    double beside = 0;      ///< level of the signal just beside its pulses, from the baseline
    double mostBeside = 0;  ///< the largest of all pulses that were looked at

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
    ChannelSearch(const Capture& capture, double noise, double lsb, const MeasureOptions& options)
        : capture_(capture), noise_(noise), lsb_(lsb), gapMax_s_(options.interPhaseGapMax.count()) {}

    [[nodiscard]] Attempt logic(const SampleView& view, const SampleBlocks& blocks) const {
        Attempt attempt;
        attempt.levels = findStateLevels(blocks, 0, true);
        if (attempt.hasStates()) finish(findPhases(view, blocks, attempt.levels, Sides::Both), attempt);
        return attempt;
    }

    /// The least averaged view of `base` in which pulses are reliable; `base` itself where there is none.
    [[nodiscard]] Attempt best(const SampleView& base, const SampleBlocks& blocks) const {
        Attempt plain = on(base, blocks);
        const double standsOut = strongOf(plain.levels);
        if (plain.hasStates() && standsOut >= kReliable) return complete(base, std::move(plain));
        std::size_t mean = plain.hasStates() ? std::max<std::size_t>(2, meanFor(standsOut)) : 4;
        // Each step goes to a longer mean, but for one step back to the shortest that is reliable.
        for (bool back = false; mean <= kLongestMean && base.samples.size() / mean >= 20;) {
            const auto view = averaged(base, mean);
            Attempt attempt = on(view, SampleBlocks(view.samples));
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
    [[nodiscard]] Attempt complete(const SampleView& view, Attempt found) const {
        return judged(view, withSecondSide(view, std::move(found)));
    }

    /// What is not whole is flagged, and what does not stand on its baseline refused.
    [[nodiscard]] Attempt judged(const SampleView& view, Attempt whole) const {
        if (!whole.hasStates()) return whole;
        markCutPulses(view, whole);
        lookBeside(view, whole);
        const double height = heightOf(whole.levels);
        // A second phase is larger than that: the baseline itself has moved.
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

    /// With two states only one side is known. Where the record begins or ends on the other, a phase is cut there that
    /// may belong to the pulse beside it.
    void markCutPulses(const SampleView& view, Attempt& found) const {
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
        // Only noise of half a step and more lets a mean see between two codes.
        return noise_ > kDithers * lsb_ ? lsb_ / std::sqrt(static_cast<double>(view.mean)) : lsb_;
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

    [[nodiscard]] Attempt on(const SampleView& view, const SampleBlocks& blocks) const {
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
        void add(const Silence& other) noexcept {
            sum += other.sum;
            n += other.n;
        }
    };

    /// The samples between two positions, from the baseline.
    [[nodiscard]] static Silence silence(const SampleView& view, const Attempt& found, double from, double to) {
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

    /// Positions of a pulse, and of the silence about it.
    struct Place {
        double width, onset, end;
        double silentFrom, silentTo;
        bool first, last;

        Place(const SampleView& view, const Attempt& found, std::size_t k)
            : first(k == 0), last(k + 1 == found.pulses.size()) {
            const auto& p = found.pulses[k];
            width = p.leading.width_s * view.rate_hz;
            onset = view.positionOf(p.leading.onset_s);
            end = view.positionOf(p.seenTo_s);
            silentFrom = first ? 0 : view.positionOf(found.pulses[k - 1].seenTo_s);
            silentTo =
                last ? static_cast<double>(view.samples.size()) : view.positionOf(found.pulses[k + 1].seenFrom_s);
        }
    };
    static constexpr double kFrom = 0.5, kTo = 2.5;  // widths from a pulse

    /// Up to two widths, half a width before the pulse; where the silence is short, its middle half.
    [[nodiscard]] static Silence before(const SampleView& view, const Attempt& found, const Place& p) {
        const double quarter = 0.25 * (p.onset - p.silentFrom);
        return silence(view, found, std::max(p.onset - kTo * p.width, p.silentFrom + (p.first ? 0 : quarter)),
                       p.onset - std::min(kFrom * p.width, quarter));
    }
    /// The same after it, or `later` times two widths further on.
    [[nodiscard]] static Silence after(const SampleView& view, const Attempt& found, const Place& p,
                                       std::size_t later = 0) {
        const double quarter = 0.25 * (p.silentTo - p.end);
        const double shift = static_cast<double>(later) * (kTo - kFrom) * p.width;
        return silence(view, found, p.end + shift + std::min(kFrom * p.width, quarter),
                       std::min(p.end + shift + kTo * p.width, p.silentTo - (p.last ? 0 : quarter)));
    }

    /// Every so many pulses are looked at.
    template <class Look>
    static void lookAtPulses(const Attempt& found, Look look) {
        const std::size_t stride = std::max<std::size_t>(1, found.pulses.size() / kJudgedPulses);
        for (std::size_t k = 0; k < found.pulses.size(); k += stride) {
            if (found.pulses[k].flags.measured()) look(k);
        }
    }

    /// A wave of the baseline that is measured as a pulse: low and long beside the others, and without a plateau.
    [[nodiscard]] static const PhaseMeasurement* slowWave(const Attempt& found) {
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

    struct AfterPulses {
        double difference = 0;  // after less before
        double before = 0;
    };

    /// The level after pulses, as far as a second phase may begin, against that just before them, where the difference
    /// goes against the pulses and exceeds the noise: five standard deviations of the means.
    [[nodiscard]] std::optional<AfterPulses> levelAfter(const SampleView& view, const Attempt& found) const {
        constexpr std::size_t kWindows = 8;
        Silence ahead;
        std::array<Silence, kWindows> behind{};
        double amplitude = 0;
        lookAtPulses(found, [&](std::size_t k) {
            const Place place(view, found, k);
            ahead.add(before(view, found, place));
            for (std::size_t later = 0; later < kWindows; ++later) {
                if (later > 0 && static_cast<double>(later) * 2 * place.width > gapMax_s_ * view.rate_hz) break;
                behind[later].add(after(view, found, place, later));
            }
            amplitude = found.pulses[k].leading.plateau;
        });
        // A record that begins too late for the level before its pulses has the baseline.
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

    /// How far the signal lies from the baseline just beside its pulses, beyond the noise: of the larger side, the RMS
    /// over pulses and the most.
    void lookBeside(const SampleView& view, Attempt& found) const {
        // The mean of a few samples has a slowly moving baseline in it whole: noise is what neighbours differ by.
        const double noise = std::min(found.levels.noise, kWhite * neighbourNoise(view.samples, lsbOf(view)));
        double squares = 0, n = 0;
        lookAtPulses(found, [&](std::size_t k) {
            const Place place(view, found, k);
            double largest = 0;
            const bool hidden = found.levelAfter != 0;  // is known already
            for (const auto& one : {before(view, found, place), hidden ? Silence{} : after(view, found, place)}) {
                const double level = one.n > 0 ? std::abs(one.mean()) : 0;
                if (level > kNoNoise * noise / std::sqrt(one.n)) largest = std::max(largest, level);
            }
            found.mostBeside = std::max(found.mostBeside, largest);
            squares += largest * largest;
            n += 1;
        });
        found.beside = n > 0 ? std::sqrt(squares / n) : 0;
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
    Attempt attempt;
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
        // A phase of half a block's length moves its median: what was taken for drift was pulses.
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
    // Where a second phase may be missed, a pulse without one is not known to lack it.
    for (auto& pulse : found.pulses) {
        if (found.quality.doubtful && !pulse.second) pulse.imbalance = kNotMeasured;
    }
    found.quality.unrest = attempt.unrest;
    // As a standard deviation that holds for each pulse: the most is no more than two.
    const double beside = std::max(attempt.beside, 0.5 * attempt.mostBeside);
    if (beside > std::max(kUnseenInSteps * lsb, kUnseen * heightOf(found.levels))) {
        found.quality.unrest = std::max(attempt.unrest, beside);
    }
    found.quality.levelAfter = attempt.levelAfter;
    return found;
}

}  // namespace tacto
