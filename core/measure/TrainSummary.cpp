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

double groupingGap(const MeasureOptions& options) {
    if (options.trainGap) return options.trainGap->count();
    if (options.intraTrainRate && options.intraTrainRate->value() > 0) return 1.5 / options.intraTrainRate->value();
    return 0;
}

TrainMeasurement trainOf(const std::vector<FoundPulse>& pulses, std::size_t first, std::size_t last) {
    TrainMeasurement train;
    double amplitude = 0, width = 0, charge = 0, imbalance = 0;
    int polarity = 0;
    for (std::size_t i = first; i < last; ++i) {
        const auto& pulse = pulses[i].pulse;
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
    train.onset_s = pulses[first].pulse.onset_s();
    return train;
}

void groupTrains(const std::vector<FoundPulse>& pulses, double gap, std::vector<TrainMeasurement>& trains) {
    for (std::size_t first = 0; first < pulses.size();) {
        std::size_t last = first + 1;
        const auto belongs = [&](std::size_t i) {
            return !pulses[i].afterBreak && pulses[i].approximateOnset_s - pulses[i - 1].approximateOnset_s <= gap;
        };
        while (last < pulses.size() && belongs(last)) ++last;
        trains.push_back(trainOf(pulses, first, last));
        // A flagged first pulse leaves its onset NaN, and with it this interval and the one before.
        if (first > 0 && !pulses[first].afterBreak) {
            auto& before = trains[trains.size() - 2];
            before.interval_s = trains.back().onset_s - before.onset_s;
        }
        first = last;
    }
}

MeasurementUncertainty uncertaintyOf(const ChannelMeasurement& result, const CaptureChannel& channel) {
    MeasurementUncertainty u;
    if (result.measuredPulses == 0) return u;
    const double amplitude = result.amplitude.mean;
    const double samples = std::max(1.0, 0.6 * result.width_s.mean * result.rate_hz);
    const double noise = result.states.noise / std::sqrt(samples);
    const double resolution = channel.lsb / std::sqrt(12.0);
    const double gain = channel.gainTolerance * amplitude / std::sqrt(3.0);
    const double offset = channel.offsetTolerance / std::sqrt(3.0);
    u.amplitude = std::hypot(std::hypot(noise, resolution), std::hypot(gain, offset));
    // Two edges, each somewhere within a step; and noise moves each by itself over the edge's steepness.
    const double step = 1.0 / result.rate_hz;
    const double edge = std::max(std::isfinite(result.rise_s.mean) ? result.rise_s.mean / 0.8 : 0, step);
    const double jitter = amplitude > 0 ? std::sqrt(2.0) * result.states.noise * edge / amplitude : 0;
    u.width_s = u.interval_s = std::hypot(step / std::sqrt(6.0), jitter);
    return u;
}

void warnOfPulses(ChannelMeasurement& result) {
    const auto warn = [&](const char* what, auto holds) {
        const auto n = std::count_if(result.pulses.begin(), result.pulses.end(), holds);
        if (n == 0) return;
        result.warnings.push_back(
            fmt::format("channel '{}': {} {} {}", result.name, n, n == 1 ? "pulse" : "pulses", what));
    };
    warn("clipped by the input range: not measured", [](const auto& p) { return p.flags.clipped; });
    warn("cut off by the record's ends: not measured", [](const auto& p) { return p.flags.truncated; });
    warn("with missing samples: not measured", [](const auto& p) { return p.flags.incomplete; });
    warn("with fewer than 10 samples in a phase: not measured",
         [](const auto& p) { return p.flags.underSampled && !p.flags.truncated && !p.flags.incomplete; });
    warn(fmt::format("with only 10 to 40 samples in a phase: widths are uncertain by {} (s.d.)",
                     formatQuantity(result.uncertainty.width_s, "s", 2))
             .c_str(),
         [](const auto& p) { return p.flags.coarse && p.flags.measured(); });
    if (result.states.count == StateCount::Three) {
        warn("without a second phase", [](const auto& p) { return p.flags.measured() && !p.second; });
    }
}

}  // namespace

void summarise(std::vector<FoundPulse> pulses, const CaptureChannel& channel, const MeasureOptions& options,
               ChannelMeasurement& result) {
    groupTrains(pulses, groupingGap(options), result.trains);
    result.pulses.reserve(pulses.size());
    for (const auto& found : pulses) result.pulses.push_back(found.pulse);
    result.measuredPulses = static_cast<std::size_t>(
        std::count_if(result.pulses.begin(), result.pulses.end(), [](const auto& p) { return p.flags.measured(); }));

    // Flagged pulses carry NaN throughout and so count nowhere.
    const auto& all = result.pulses;
    result.amplitude = statisticsOver(all, [](const auto& p) { return std::abs(p.leading.plateau); });
    result.width_s = statisticsOver(all, [](const auto& p) { return p.leading.width_s; });
    result.rise_s = statisticsOver(all, [](const auto& p) { return p.leading.rise_s; });
    result.fall_s = statisticsOver(all, [](const auto& p) { return p.leading.fall_s; });
    result.overshoot = statisticsOver(all, [](const auto& p) { return p.leading.overshoot; });
    result.droop = statisticsOver(all, [](const auto& p) { return p.leading.droop; });
    result.charge = statisticsOver(all, [](const auto& p) { return std::abs(p.leading.charge); });
    result.gap_s = statisticsOver(all, [](const auto& p) { return p.gap_s; });
    result.imbalance = statisticsOver(all, [](const auto& p) { return p.imbalance; });
    result.interval_s = statisticsOver(result.trains, [](const auto& t) { return t.interval_s; });
    result.uncertainty = uncertaintyOf(result, channel);
    warnOfPulses(result);
}

}  // namespace tacto
