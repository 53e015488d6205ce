#include "core/measure/TrainSummary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/base/Text.h"

namespace tacto {

namespace {

/// Statistics of what `value` gives for each item, the not measured (NaN) left out.
template <class Items, class Value>
Statistics statisticsOver(const Items& items, Value value) {
    std::vector<double> readings;
    readings.reserve(items.size());
    for (const auto& item : items) {
        const double reading = value(item);
        if (!std::isnan(reading)) readings.push_back(reading);
    }
    return statisticsOf(readings);
}

/// All figures in one walk: two hundred thousand pulses do not fit the cache, and ten walks would fetch them ten times.
void statisticsOfPulses(ChannelMeasurement& m) {
    struct Figure {
        Statistics& statistics;
        double (*value)(const PulseMeasurement&);
        std::vector<double> readings{};
    };
    Figure figures[] = {{m.amplitude, [](const PulseMeasurement& p) { return std::abs(p.leading.plateau); }},
                        {m.width_s, [](const PulseMeasurement& p) { return p.leading.width_s; }},
                        {m.rise_s, [](const PulseMeasurement& p) { return p.leading.rise_s; }},
                        {m.fall_s, [](const PulseMeasurement& p) { return p.leading.fall_s; }},
                        {m.overshoot, [](const PulseMeasurement& p) { return p.leading.overshoot; }},
                        {m.droop, [](const PulseMeasurement& p) { return p.leading.droop; }},
                        {m.charge, [](const PulseMeasurement& p) { return std::abs(p.leading.charge); }},
                        {m.gap_s, [](const PulseMeasurement& p) { return p.gap_s; }},
                        {m.imbalance, [](const PulseMeasurement& p) { return p.imbalance; }}};
    for (auto& figure : figures) figure.readings.reserve(m.pulses.size());
    // Flagged pulses carry NaN throughout and so count nowhere.
    for (const auto& pulse : m.pulses) {
        for (auto& figure : figures) {
            const double reading = figure.value(pulse);
            if (!std::isnan(reading)) figure.readings.push_back(reading);
        }
    }
    for (auto& figure : figures) figure.statistics = statisticsOf(figure.readings);
}

double groupingGap(const MeasureOptions& options) {
    if (options.trainGap) return options.trainGap->count();
    if (options.intraTrainRate && options.intraTrainRate->value() > 0) return 1.5 / options.intraTrainRate->value();
    return 0;
}

TrainMeasurement trainOf(std::span<const PulseMeasurement> pulses) {
    TrainMeasurement train;
    double amplitude = 0, width = 0, charge = 0, imbalance = 0;
    int polarity = 0;
    for (const auto& pulse : pulses) {
        if (!pulse.flags.measured()) {
            ++train.flagged;
            continue;
        }
        ++train.pulses;
        amplitude += std::abs(pulse.leading.plateau);
        width += pulse.leading.width_s;
        charge += std::abs(pulse.leading.charge);
        imbalance += pulse.imbalance;
        polarity += pulse.leading.plateau > 0 ? 1 : -1;
    }
    if (train.pulses > 0) {
        const auto n = static_cast<double>(train.pulses);
        train.amplitude = amplitude / n;
        train.width_s = width / n;
        train.charge = charge / n;
        train.imbalance = imbalance / n;
        train.polarity = polarity >= 0 ? 1 : -1;
    }
    train.onset_s = pulses.front().onset_s();
    return train;
}

void groupTrains(std::span<const PulseMeasurement> pulses, std::span<const std::size_t> breaks, double gap,
                 std::vector<TrainMeasurement>& trains) {
    // Known also of a pulse that was flagged and whose numbers are gone.
    const auto approximateOnset = [&](std::size_t i) {
        return std::isnan(pulses[i].onset_s()) ? pulses[i].seenFrom_s : pulses[i].onset_s();
    };
    trains.reserve(gap > 0 ? 0 : pulses.size());
    auto nextBreak = breaks.begin();
    for (std::size_t first = 0; first < pulses.size();) {
        while (nextBreak != breaks.end() && *nextBreak < first) ++nextBreak;
        const bool afterBreak = nextBreak != breaks.end() && *nextBreak == first;
        if (afterBreak) ++nextBreak;
        const std::size_t end = nextBreak == breaks.end() ? pulses.size() : *nextBreak;
        std::size_t last = first + 1;
        while (last < end && approximateOnset(last) - approximateOnset(last - 1) <= gap) ++last;
        trains.push_back(trainOf(pulses.subspan(first, last - first)));
        // A flagged first pulse leaves its onset NaN, and with it this interval and the one before.
        if (first > 0 && !afterBreak) {
            auto& before = trains[trains.size() - 2];
            before.interval_s = trains.back().onset_s - before.onset_s;
        }
        first = last;
    }
}

/// Gap and imbalance. `random`: of the leading charge; `offset` and `resolution`: of any level; `step`: s per sample.
void addSecondPhase(const ChannelMeasurement& result, double step, double random, double offset, double resolution,
                    MeasurementUncertainty& u) {
    double n = 0, width = 0, height = 0;
    for (const auto& pulse : result.pulses) {
        if (!pulse.second) continue;
        n += 1;
        width += pulse.second->width_s;
        height += std::abs(pulse.second->plateau);
    }
    const double charge = result.charge.mean;
    if (!(n > 0) || !(charge > 0) || !(height > 0)) return;
    width /= n;
    height /= n;
    const double ownStep =
        step * static_cast<double>(result.quality.meanOfSecond) / static_cast<double>(result.quality.mean);
    // White noise: the mean of more samples has less of it.
    const double jitter = result.states.noise * std::sqrt(step / ownStep) * ownStep / height;
    u.gap_s = std::hypot(u.width_s, std::hypot(ownStep > step ? ownStep / std::sqrt(6.0) : 0, jitter));
    // A gain is the same for both charges and divides out; an offset adds to one what it takes from the other. Edges
    // that fall between samples are the same for both where the phases are.
    const double second = std::hypot(result.states.noise * std::sqrt(step * width), height * ownStep / std::sqrt(6.0));
    const double baseline = result.states.noise * std::sqrt(step / width) * width;
    const double shared = std::hypot(offset, resolution) * (result.width_s.mean + width);
    u.imbalance = std::hypot(std::hypot(random, std::hypot(second, baseline)), shared) / charge;
}

MeasurementUncertainty uncertaintyOf(const ChannelMeasurement& result, const CaptureChannel& channel) {
    MeasurementUncertainty u;
    if (result.measuredPulses == 0) return u;
    const double amplitude = result.amplitude.mean;
    const double step = static_cast<double>(result.quality.mean) / result.rate_hz;  // of what was measured
    const double width = result.width_s.mean;
    const double noise = result.states.noise / std::sqrt(std::max(1.0, 0.6 * width / step));
    const double resolution = channel.lsb / std::sqrt(12.0);
    const double gain = channel.gainTolerance * amplitude / std::sqrt(3.0);
    const double offset = std::hypot(channel.offsetTolerance / std::sqrt(3.0), result.quality.unrest);
    u.amplitude = std::hypot(std::hypot(noise, resolution), std::hypot(gain, offset));
    // Two edges, each somewhere within a step; and noise moves each by itself over the edge's steepness.
    const double edge = std::max(std::isfinite(result.rise_s.mean) ? result.rise_s.mean / 0.8 : 0, step);
    const double jitter = amplitude > 0 ? std::sqrt(2.0) * result.states.noise * edge / amplitude : 0;
    u.width_s = u.interval_s = std::hypot(step / std::sqrt(6.0), jitter);
    // Over the width, the edges, and the baseline that is subtracted all along.
    const auto chargeNoise = [&](double length, double height, double sampling) {
        const double samples = result.states.noise * std::sqrt(sampling * (length + 4 * edge));
        return std::hypot(std::hypot(samples, noise * length), height * sampling / std::sqrt(6.0));
    };
    const double random = chargeNoise(width, amplitude, step);
    u.charge = std::hypot(std::hypot(random, resolution * width), std::hypot(gain, offset) * width);
    if (result.states.count == StateCount::Three) addSecondPhase(result, step, random, offset, resolution, u);
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
    if (quality.drift > 0) {
        warn(fmt::format("its baseline moves by {} and was followed", formatQuantity(quality.drift, result.unit, 2)));
    }
    if (quality.levelAfter != 0) {
        warn(
            fmt::format("after its pulses it lies {} from where it was before them: a second phase is hidden in the "
                        "noise and not measured",
                        formatQuantity(quality.levelAfter, result.unit, 2)));
    }
    if (quality.unrest > 0) {
        warn(fmt::format("its baseline moves by {} (s.d.), more than its noise: levels and charges are uncertain by it",
                         formatQuantity(quality.unrest, result.unit, 2)));
    }
}

void warnOfPulses(ChannelMeasurement& result) {
    // One walk, as for the figures.
    std::size_t clipped = 0, truncated = 0, incomplete = 0, underSampled = 0, coarse = 0, single = 0;
    for (const auto& pulse : result.pulses) {
        const auto& flags = pulse.flags;
        clipped += flags.clipped ? 1 : 0;
        truncated += flags.truncated ? 1 : 0;
        incomplete += flags.incomplete ? 1 : 0;
        underSampled += flags.underSampled && !flags.truncated && !flags.incomplete ? 1 : 0;
        coarse += flags.coarse && flags.measured() ? 1 : 0;
        single += flags.measured() && !pulse.second ? 1 : 0;
    }
    const auto warn = [&](std::size_t n, std::string_view what) {
        if (n == 0) return;
        result.warnings.push_back(
            fmt::format("channel '{}': {} {} {}", result.name, n, n == 1 ? "pulse" : "pulses", what));
    };
    warn(clipped, "clipped by the input range: not measured");
    warn(truncated, "cut off by the record's ends: not measured");
    warn(incomplete, "with missing samples: not measured");
    warn(underSampled, "with fewer than 10 samples in a phase: not measured");
    warn(coarse, fmt::format("with only 10 to 40 samples in a phase: widths are uncertain by {} (s.d.)",
                             formatQuantity(result.uncertainty.width_s, "s", 2)));
    if (result.states.count == StateCount::Three) warn(single, "without a second phase");
}

}  // namespace

void summarise(std::vector<PulseMeasurement> pulses, std::span<const std::size_t> breaks, const CaptureChannel& channel,
               const MeasureOptions& options, ChannelMeasurement& result) {
    groupTrains(pulses, breaks, groupingGap(options), result.trains);
    result.pulses = std::move(pulses);
    result.measuredPulses = static_cast<std::size_t>(
        std::count_if(result.pulses.begin(), result.pulses.end(), [](const auto& p) { return p.flags.measured(); }));

    statisticsOfPulses(result);
    result.interval_s = statisticsOver(result.trains, [](const auto& t) { return t.interval_s; });
    result.uncertainty = uncertaintyOf(result, channel);
    warnOfQuality(result);
    warnOfPulses(result);
}

}  // namespace tacto
