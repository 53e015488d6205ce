#include "core/measure/TrainSummary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

#include "core/base/LargeReserve.h"
#include "core/base/QuantityText.h"
#include "core/base/Statistics.h"

namespace tacto {

namespace {

/// Collects the readings of one quantity over many pulses or trains.
class Readings {
public:
    /// `most`: largest number of readings to be added.
    explicit Readings(std::size_t most) { reserveLarge(values_, most); }

    /// Adds a reading, unless it was not measured (NaN).
    void add(double reading) {
        if (!std::isnan(reading)) values_.push_back(reading);
    }
    [[nodiscard]] Statistics statistics() const { return statisticsOf(values_); }

private:
    std::vector<double> values_;
};

/// Groups pulses into trains and computes the means of each train.
class TrainGrouping {
public:
    /// Pulses with onsets at most `gap` apart form one train. `breaks`, ascending: pulses that follow an unknown time;
    /// must outlive this object. `pulses`: how many will be added.
    TrainGrouping(double gap, std::span<const std::size_t> breaks, std::size_t pulses);

    /// Adds the next pulse in time.
    void add(const PulseMeasurement& pulse);
    /// Ends the grouping. Call it once, after the last pulse.
    [[nodiscard]] std::vector<TrainMeasurement> finish();

private:
    void begin(const PulseMeasurement& pulse, bool afterBreak);
    void end();

    double gap_;
    std::span<const std::size_t> breaks_;  ///< breaks not reached yet
    std::size_t added_ = 0;
    double lastOnset_s_ = 0;
    std::vector<TrainMeasurement> trains_;  ///< the last train holds sums until it ends
};

TrainGrouping::TrainGrouping(double gap, std::span<const std::size_t> breaks, std::size_t pulses)
    : gap_(gap), breaks_(breaks) {
    // Without a gap each pulse is a train of its own.
    if (!(gap > 0)) reserveLarge(trains_, pulses);
}

void TrainGrouping::add(const PulseMeasurement& pulse) {
    const bool afterBreak = !breaks_.empty() && breaks_.front() == added_;
    if (afterBreak) breaks_ = breaks_.subspan(1);
    // Known even for a flagged pulse that has no numbers.
    const double onset_s = std::isnan(pulse.onset_s()) ? pulse.seenFrom_s : pulse.onset_s();
    if (added_ == 0 || afterBreak || !(onset_s - lastOnset_s_ <= gap_)) begin(pulse, afterBreak);
    lastOnset_s_ = onset_s;
    ++added_;

    auto& train = trains_.back();
    if (!pulse.flags.measured()) {
        ++train.flagged;
        return;
    }
    ++train.pulses;
    train.amplitude += std::abs(pulse.leading.plateau);
    train.width_s += pulse.leading.width_s;
    train.charge += std::abs(pulse.leading.charge);
    train.imbalance += pulse.imbalance;
    train.polarity += pulse.leading.plateau > 0 ? 1 : -1;
}

std::vector<TrainMeasurement> TrainGrouping::finish() {
    if (!trains_.empty()) end();
    return std::move(trains_);
}

void TrainGrouping::begin(const PulseMeasurement& pulse, bool afterBreak) {
    if (!trains_.empty()) {
        end();
        // If the first pulse is flagged, its onset is NaN; this interval and the one before are then NaN too.
        if (!afterBreak) trains_.back().interval_s = pulse.onset_s() - trains_.back().onset_s;
    }
    auto& train = trains_.emplace_back();
    train.onset_s = pulse.onset_s();
    train.amplitude = train.width_s = train.charge = train.imbalance = 0;
}

void TrainGrouping::end() {
    auto& train = trains_.back();
    const double n = train.pulses > 0 ? static_cast<double>(train.pulses) : kNotMeasured;
    train.amplitude /= n;
    train.width_s /= n;
    train.charge /= n;
    train.imbalance /= n;
    if (train.pulses > 0) train.polarity = train.polarity >= 0 ? 1 : -1;
}

constexpr double kLongInterval = 1.5;  // times the shortest: a longer interval may contain a pulse hidden in noise

/// Collects all reported figures in one pass: two hundred thousand pulses do not fit into the cache, and one pass per
/// figure would load them ten times.
class PulseFigures {
public:
    PulseFigures(std::size_t pulses, bool biphasic) : leading_(pulses), both_(biphasic ? pulses : 0) {}

    /// Flagged pulses hold NaN in all figures, so they add no reading.
    void add(const PulseMeasurement& pulse) {
        const auto& leading = pulse.leading;
        amplitude_.add(std::abs(leading.plateau));
        width_s_.add(leading.width_s);
        rise_s_.add(leading.rise_s);
        fall_s_.add(leading.fall_s);
        overshoot_.add(leading.overshoot);
        droop_.add(leading.droop);
        charge_.add(std::abs(leading.charge));
        gap_s_.add(pulse.gap_s);
        imbalance_.add(pulse.imbalance);
    }
    void fill(ChannelMeasurement& m) const {
        m.amplitude = amplitude_.statistics();
        m.width_s = width_s_.statistics();
        m.rise_s = rise_s_.statistics();
        m.fall_s = fall_s_.statistics();
        m.overshoot = overshoot_.statistics();
        m.droop = droop_.statistics();
        m.charge = charge_.statistics();
        m.gap_s = gap_s_.statistics();
        m.imbalance = imbalance_.statistics();
    }

private:
    std::size_t leading_;  ///< number of readings of leading phases
    std::size_t both_;     ///< number of pulses with two phases
    Readings amplitude_{leading_}, width_s_{leading_}, rise_s_{leading_}, fall_s_{leading_}, overshoot_{leading_},
        droop_{leading_}, charge_{leading_}, gap_s_{both_}, imbalance_{both_};
};

/// Counts of the pulses that warnings mention.
struct PulseCounts {
    std::size_t measured = 0, clipped = 0, truncated = 0, incomplete = 0, underSampled = 0, coarse = 0, single = 0;
    std::size_t flatTop = 0;

    void add(const PulseMeasurement& pulse) {
        const auto& flags = pulse.flags;
        const bool isMeasured = flags.measured();
        measured += isMeasured ? 1 : 0;
        clipped += flags.clipped ? 1 : 0;
        truncated += flags.truncated ? 1 : 0;
        incomplete += flags.incomplete ? 1 : 0;
        underSampled += flags.underSampled && !flags.truncated && !flags.incomplete ? 1 : 0;
        coarse += flags.coarse && isMeasured ? 1 : 0;
        flatTop += flags.flatTop && isMeasured ? 1 : 0;
        single += isMeasured && !pulse.second ? 1 : 0;
    }
};

/// Sums over all second phases.
struct SecondPhases {
    double n = 0, width = 0, height = 0;

    void add(const PulseMeasurement& pulse) {
        if (!pulse.second) return;
        n += 1;
        width += pulse.second->width_s;
        height += std::abs(pulse.second->plateau);
    }
};

double groupingGap(const MeasureOptions& options) {
    if (options.trainGap) return options.trainGap->count();
    if (options.intraTrainRate && options.intraTrainRate->value() > 0) return 1.5 / options.intraTrainRate->value();
    return 0;
}

/// Sets the uncertainties of gap and imbalance. Relative errors: `random` of the leading charge, `level` of levels.
void addSecondPhase(const ChannelMeasurement& result, double step, double random, double level,
                    const SecondPhases& seconds, MeasurementUncertainty& u) {
    const double charge = result.charge.mean;
    if (!(seconds.n > 0) || !(charge > 0) || !(seconds.height > 0)) return;
    const double width = seconds.width / seconds.n;
    const double height = seconds.height / seconds.n;
    const double ownStep =
        step * static_cast<double>(result.quality.meanOfSecond) / static_cast<double>(result.quality.mean);
    // White noise: a mean of more samples has less noise.
    const double jitter = result.states.noise * std::sqrt(step / ownStep) * ownStep / height;
    u.gap_s = std::hypot(u.width_s, std::hypot(ownStep > step ? ownStep / std::sqrt(6.0) : 0, jitter));
    // A gain error affects both charges equally and cancels. A baseline error adds to one charge what it takes from the
    // other. The errors of edges between samples are equal if the phases are alike.
    const double second = std::hypot(result.states.noise * std::sqrt(step * width), height * ownStep / std::sqrt(6.0));
    const double baseline = result.states.noise * std::sqrt(step / width) * width;
    const double shared = level * (result.width_s.mean + width);
    u.imbalance = std::hypot(std::hypot(random, std::hypot(second, baseline)), shared) / charge;
}

MeasurementUncertainty uncertaintyOf(const ChannelMeasurement& result, const CaptureChannel& channel,
                                     const SecondPhases& seconds, const TimeTolerance& time) {
    MeasurementUncertainty u;
    if (result.measuredPulses == 0) return u;
    const double amplitude = result.amplitude.mean;
    const double step = static_cast<double>(result.quality.mean) / result.rate_hz;  // time between two values
    const double width = result.width_s.mean;
    const double noise = result.states.noise / std::sqrt(std::max(1.0, 0.6 * width / step));
    // Unstated values are NaN, and so are all results that need them. A level is a difference of two readings, each
    // rounded to a step; an offset is in both and cancels.
    const double lsb = channel.lsb > 0 ? channel.lsb : result.quality.foundStep;
    const double resolution = (lsb > 0 ? lsb : kNotMeasured) / std::sqrt(6.0);
    const double gain =
        std::hypot(std::hypot(channel.gainTolerance, channel.probeTolerance) * amplitude, channel.linearityTolerance) /
        std::sqrt(3.0);
    const double unrest = result.quality.unrest;
    u.amplitude = std::hypot(std::hypot(noise, resolution), std::hypot(gain, unrest));
    // Each of two edges lies somewhere within a step. Noise shifts each edge independently, less if the edge is steep.
    const double edge = std::max(std::isfinite(result.rise_s.mean) ? result.rise_s.mean / 0.8 : 0, step);
    const double jitter = amplitude > 0 ? std::sqrt(2.0) * result.states.noise * edge / amplitude : 0;
    const double edges = std::hypot(step / std::sqrt(6.0), jitter);
    u.width_s = std::hypot(edges, time.base * width / std::sqrt(3.0));
    u.interval_s = std::hypot(std::hypot(edges, time.base * result.interval_s.mean / std::sqrt(3.0)),
                              std::sqrt(2.0 / 3.0) * time.stamp_s);
    // Noise over the width, the two edges, and the error of the subtracted baseline.
    const auto chargeNoise = [&](double length, double height, double sampling) {
        const double samples = result.states.noise * std::sqrt(sampling * (length + 4 * edge));
        return std::hypot(std::hypot(samples, noise * length), height * sampling / std::sqrt(6.0));
    };
    const double random = chargeNoise(width, amplitude, step);
    u.charge = std::hypot(std::hypot(random, resolution * width), std::hypot(gain, unrest) * width);
    if (result.states.count == StateCount::Three)
        addSecondPhase(result, step, random, std::hypot(unrest, resolution), seconds, u);
    return u;
}

void warnOfQuality(ChannelMeasurement& result) {
    if (result.states.count == StateCount::None) return;
    const auto& quality = result.quality;
    const auto warn = [&](std::string what) {
        result.warnings.push_back(fmt::format("channel '{}': {}", result.name, what));
    };
    if (quality.doubtful) {
        warn(fmt::format("its noise is only {:.0f} dB below its pulses: pulses may be missing or invented",
                         quality.snr_db));
    }
    if (quality.mean > 1) {
        warn(fmt::format("its noise asked for the mean of every {} samples before measuring", quality.mean));
    }
    if (quality.leaps > 0) {
        warn(fmt::format("{} of its samples {} far from both neighbours and {} left out", quality.leaps,
                         quality.leaps == 1 ? "lies" : "lie", quality.leaps == 1 ? "was" : "were"));
    }
    if (quality.drift > 0) {
        warn(fmt::format("its baseline moves by {} and was followed", scaledText(quality.drift, result.unit, 2)));
    }
    if (quality.levelAfter != 0) {
        warn(
            fmt::format("after its pulses it lies {} from where it was before them: a second phase is hidden in the "
                        "noise and not measured",
                        scaledText(quality.levelAfter, result.unit, 2)));
    }
    if (quality.unrest > 0) {
        warn(fmt::format("its baseline moves by {} (s.d.), more than its noise: levels and charges are uncertain by it",
                         scaledText(quality.unrest, result.unit, 2)));
    }
}

/// Removes intervals in which noise may have hidden a pulse. Returns how many.
std::size_t leaveOutLongIntervals(std::vector<TrainMeasurement>& trains) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto& train : trains) {
        if (train.interval_s < shortest) shortest = train.interval_s;
    }
    std::size_t left = 0;
    for (auto& train : trains) {
        if (!(train.interval_s > kLongInterval * shortest)) continue;
        train.interval_s = kNotMeasured;
        ++left;
    }
    return left;
}

void warnOfPulses(const PulseCounts& counts, ChannelMeasurement& result) {
    const auto warn = [&](std::size_t n, std::string_view what) {
        if (n == 0) return;
        result.warnings.push_back(
            fmt::format("channel '{}': {} {} {}", result.name, n, n == 1 ? "pulse" : "pulses", what));
    };
    warn(counts.clipped, "clipped by the input range: not measured");
    warn(counts.truncated, "cut off by the record's ends: not measured");
    warn(counts.incomplete, "with missing samples: not measured");
    warn(counts.underSampled, "with fewer than 10 samples in a phase: not measured");
    const double step = static_cast<double>(result.quality.mean) / result.rate_hz;
    warn(counts.coarse, fmt::format("with only 10 to 40 samples in a phase: widths are uncertain by {} (s.d.) or more",
                                    scaledText(step / std::sqrt(6.0), "s", 2)));
    warn(counts.flatTop,
         "with a flat top at the record's own extreme in spite of the noise: it may be clipped, so that the signal may "
         "be larger; no input range is stated that would tell");
    if (result.states.count == StateCount::Three) warn(counts.single, "without a second phase");
}

}  // namespace

void summarise(std::vector<PulseMeasurement> pulses, std::span<const std::size_t> breaks, const CaptureChannel& channel,
               const TimeTolerance& time, const MeasureOptions& options, ChannelMeasurement& result) {
    result.pulses = std::move(pulses);
    const std::size_t n = result.pulses.size();
    TrainGrouping trains(groupingGap(options), breaks, n);
    PulseFigures figures(n, result.states.count == StateCount::Three);
    PulseCounts counts;
    SecondPhases seconds;
    for (const auto& pulse : result.pulses) {
        trains.add(pulse);
        figures.add(pulse);
        counts.add(pulse);
        seconds.add(pulse);
    }
    result.trains = trains.finish();
    result.measuredPulses = counts.measured;
    figures.fill(result);
    const auto doubled = result.quality.doubtful ? leaveOutLongIntervals(result.trains) : 0;
    Readings intervals(result.trains.size());
    for (const auto& train : result.trains) intervals.add(train.interval_s);
    result.interval_s = intervals.statistics();
    result.uncertainty = uncertaintyOf(result, channel, seconds, time);
    warnOfQuality(result);
    if (doubled > 0) {
        result.warnings.push_back(
            fmt::format("channel '{}': {} {} not measured: longer than {:g} times the shortest, so that a pulse may be "
                        "missing in it",
                        result.name, doubled, doubled == 1 ? "interval" : "intervals", kLongInterval));
    }
    warnOfPulses(counts, result);
}

}  // namespace tacto
