#include "core/measure/LoadMeasurement.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <span>

#include "core/measure/Clipping.h"

namespace tacto {

namespace {

constexpr double kBeforeFrom = 2.0;  // widths before the onset: start of the silence used as zero voltage
constexpr double kBeforeTo = 0.25;
constexpr std::size_t kMinSamplesBefore = 5;  // fewest samples in that silence
constexpr double kLineFrom = 0.5;             // start of the line, as a share of the width
constexpr double kLineTo = 0.95;
// A line fitted to n samples is less certain at the end of the width than their mean is, by this factor: √(1 + 12·((1 -
// 0.725)/0.45)²).
constexpr double kEndOfLine = 2.34;

struct Range {
    std::size_t first = 0;
    std::size_t end = 0;
    [[nodiscard]] std::size_t size() const noexcept { return end > first ? end - first : 0; }
};

class LoadOfPulse {
public:
    LoadOfPulse(const Capture& capture, const CaptureChannel& voltage, const CaptureChannel& current)
        : rate_hz_(capture.rate_hz), start_s_(capture.start_s), voltage_(voltage), current_(current) {}

    /// `silentFrom_s`: the end of the previous pulse. All numbers are NaN if the voltage cannot be measured.
    [[nodiscard]] PulseLoad of(const PulseMeasurement& pulse, double silentFrom_s, const ChannelMeasurement& current,
                               double voltageNoise) const {
        PulseLoad load;
        load.onset_s = pulse.leading.onset_s;
        const double width_s = pulse.leading.width_s;
        const double end_s = pulse.second ? pulse.second->end_s : pulse.leading.end_s;
        const auto silence = between(std::max(load.onset_s - kBeforeFrom * width_s, silentFrom_s + kBeforeTo * width_s),
                                     load.onset_s - kBeforeTo * width_s);
        const auto whole = between(load.onset_s - 0.1 * width_s, end_s + 0.1 * width_s);
        if (silence.size() < kMinSamplesBefore || !isUsable(whole)) return load;
        const double zero_v = mean(voltage_.samples, silence);
        const double zero_a = current.states.baseline;
        load.voltage_v = atEnd(voltage_.samples, pulse.leading) - zero_v;
        load.current_a = atEnd(current_.samples, pulse.leading) - zero_a;
        load.load_ohm = load.voltage_v / load.current_a;
        load.charge_c = pulse.leading.charge;
        if (pulse.second) load.secondCharge_c = pulse.second->charge;
        load.netCharge_c = load.charge_c + (pulse.second ? load.secondCharge_c : 0);
        load.energy_j = energy(whole, zero_v, zero_a);
        double volts = 0, amperes = 0;
        addSquares(pulse.leading, zero_v, zero_a, volts, amperes, voltageNoise, current.states.noise);
        if (pulse.second) addSquares(*pulse.second, zero_v, zero_a, volts, amperes, voltageNoise, current.states.noise);
        if (volts > 0 && amperes > 0) load.impedance_ohm = std::sqrt(volts / amperes);
        return load;
    }

private:
    /// Returns the samples at or after `from_s` and before `to_s` that lie within the record.
    [[nodiscard]] Range between(double from_s, double to_s) const {
        const double last = static_cast<double>(voltage_.samples.size());
        const auto at = [&](double t) {
            return static_cast<std::size_t>(std::clamp(std::ceil((t - start_s_) * rate_hz_), 0.0, last));
        };
        return {at(from_s), at(to_s)};
    }
    [[nodiscard]] bool isUsable(const Range& range) const {
        for (std::size_t i = range.first; i < range.end; ++i) {
            const double v = static_cast<double>(voltage_.samples[i]);
            if (!std::isfinite(v) || !std::isfinite(current_.samples[i])) return false;
            if (limits_ && limits_->reachedBy(v)) return false;
        }
        return range.size() > 0;
    }
    [[nodiscard]] static double mean(const std::vector<float>& samples, const Range& range) {
        double sum = 0;
        for (std::size_t i = range.first; i < range.end; ++i) sum += static_cast<double>(samples[i]);
        return sum / static_cast<double>(range.size());
    }
    /// Fits a line to the phase's second half and returns its value at the end of the phase.
    [[nodiscard]] double atEnd(const std::vector<float>& samples, const PhaseMeasurement& phase) const {
        const auto range = between(phase.onset_s + kLineFrom * phase.width_s, phase.onset_s + kLineTo * phase.width_s);
        if (range.size() < 2) return kNotMeasured;
        const double level = mean(samples, range);
        const double centre = 0.5 * static_cast<double>(range.first + range.end - 1);
        double moment = 0, squares = 0;
        for (std::size_t i = range.first; i < range.end; ++i) {
            const double x = static_cast<double>(i) - centre;
            moment += x * static_cast<double>(samples[i]);
            squares += x * x;
        }
        return level + moment / squares * ((phase.end_s - start_s_) * rate_hz_ - centre);
    }
    [[nodiscard]] double energy(const Range& range, double zero_v, double zero_a) const {
        double sum = 0;
        for (std::size_t i = range.first; i < range.end; ++i) {
            sum += (static_cast<double>(voltage_.samples[i]) - zero_v) *
                   (static_cast<double>(current_.samples[i]) - zero_a);
        }
        return sum / rate_hz_;
    }
    void addSquares(const PhaseMeasurement& phase, double zero_v, double zero_a, double& volts, double& amperes,
                    double voltageNoise, double currentNoise) const {
        const auto range = between(phase.onset_s, phase.end_s);
        for (std::size_t i = range.first; i < range.end; ++i) {
            const double v = static_cast<double>(voltage_.samples[i]) - zero_v;
            const double a = static_cast<double>(current_.samples[i]) - zero_a;
            volts += v * v - voltageNoise * voltageNoise;
            amperes += a * a - currentNoise * currentNoise;
        }
    }

    double rate_hz_;
    double start_s_;
    const CaptureChannel& voltage_;
    const CaptureChannel& current_;
    std::optional<ClipLimits> limits_ = clipLimits(voltage_);
};

template <class Value>
Statistics statisticsOver(const std::vector<PulseLoad>& pulses, Value value) {
    std::vector<double> readings;
    readings.reserve(pulses.size());
    for (const auto& pulse : pulses) {
        const double reading = value(pulse);
        if (!std::isnan(reading)) readings.push_back(reading);
    }
    return statisticsOf(readings);
}

/// Returns the standard uncertainty of one level, read at the end of the line and relative to the level.
double relativeUncertainty(const CaptureChannel& channel, bool gainShared, double noise, double samples, double level) {
    const double random = kEndOfLine * noise / std::sqrt(std::max(2.0, samples));
    const double step = (channel.lsb > 0 ? channel.lsb : kNotMeasured) / std::sqrt(6.0);
    const double absolute = std::hypot(std::hypot(random, step), channel.linearityTolerance / std::sqrt(3.0));
    // A gain error that voltage and current share cancels in the load.
    return std::hypot(absolute / std::abs(level),
                      std::hypot(gainShared ? 0 : channel.gainTolerance, channel.probeTolerance) / std::sqrt(3.0));
}

void summariseLoad(bool gainShared, const CaptureChannel& voltage, const CaptureChannel& current,
                   const ChannelMeasurement& pulses, double voltageNoise, LoadMeasurement& result) {
    const auto& all = result.pulses;
    result.measuredPulses = static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [](const auto& p) { return std::isfinite(p.load_ohm); }));
    result.load_ohm = statisticsOver(all, [](const auto& p) { return p.load_ohm; });
    result.impedance_ohm = statisticsOver(all, [](const auto& p) { return p.impedance_ohm; });
    result.charge_c = statisticsOver(all, [](const auto& p) { return std::abs(p.charge_c); });
    result.secondCharge_c = statisticsOver(all, [](const auto& p) { return std::abs(p.secondCharge_c); });
    result.netCharge_c = statisticsOver(all, [](const auto& p) { return p.netCharge_c; });
    result.energy_j = statisticsOver(all, [](const auto& p) { return p.energy_j; });
    if (result.measuredPulses == 0) return;
    const auto magnitude = [&](auto value) {
        return statisticsOver(all, [&](const auto& p) { return std::abs(value(p)); }).mean;
    };
    const double samples = (kLineTo - kLineFrom) * pulses.width_s.mean * pulses.rate_hz;
    const double volts = relativeUncertainty(voltage, gainShared, voltageNoise, samples,
                                             magnitude([](const auto& p) { return p.voltage_v; }));
    const double amperes = relativeUncertainty(current, gainShared, pulses.states.noise, samples,
                                               magnitude([](const auto& p) { return p.current_a; }));
    result.loadUncertainty_ohm = std::hypot(volts, amperes) * std::abs(result.load_ohm.mean);
}

/// If a voltage has no stated range and its tops look cut off, the load comes out too small. Only this warning says so.
void warnOfFlatVoltage(const Capture& capture, std::size_t voltage, const MeasureOptions& options,
                       LoadMeasurement& result) {
    if (result.measuredPulses == 0 || clipLimits(capture.channels[voltage])) return;
    const auto pulses = measureChannel(capture, voltage, options).pulses;
    if (std::ranges::none_of(pulses, [](const auto& pulse) { return pulse.flags.flatTop; })) return;
    result.warnings.push_back(fmt::format(
        "the tops of '{}' look clipped and no input range is stated that would tell: the load may be larger",
        result.voltage));
}

void warnOfLoad(const ChannelMeasurement& pulses, LoadMeasurement& result) {
    if (result.measuredPulses == 0) {
        result.warnings.push_back(
            fmt::format("no load from '{}' and '{}': no pulse is measured in both", result.voltage, result.current));
    } else if (result.measuredPulses < pulses.measuredPulses) {
        result.warnings.push_back(fmt::format("'{}' does not show the load of {} of {} pulses of '{}'", result.voltage,
                                              pulses.measuredPulses - result.measuredPulses, pulses.measuredPulses,
                                              result.current));
    }
    if (result.load_ohm.mean < 0) {
        result.warnings.push_back(fmt::format("'{}' goes against '{}': one of the probes is the wrong way round",
                                              result.voltage, result.current));
    }
}

}  // namespace

std::vector<PulseLoad> loadOfPulses(const Capture& capture, std::size_t voltage, std::size_t current,
                                    const ChannelMeasurement& measured) {
    const auto& volts = capture.channels[voltage];
    const LoadOfPulse load(capture, volts, capture.channels[current]);
    const double voltageNoise = neighbourNoise(volts.samples, volts.lsb);
    std::vector<PulseLoad> loads;
    loads.reserve(measured.pulses.size());
    double silentFrom_s = capture.start_s - 1;
    for (const auto& pulse : measured.pulses) {
        loads.push_back(pulse.flags.measured() ? load.of(pulse, silentFrom_s, measured, voltageNoise) : PulseLoad{});
        silentFrom_s = pulse.seenTo_s;
    }
    return loads;
}

Result<LoadMeasurement> measureLoad(const Capture& capture, std::size_t voltage, std::size_t current,
                                    const MeasureOptions& options) {
    const std::pair<std::size_t, const char*> wanted[] = {{voltage, "V"}, {current, "A"}};
    for (const auto& [index, unit] : wanted) {
        if (index >= capture.channels.size()) {
            return invalid("channel number {} of {}; they count from 0", index, capture.channels.size());
        }
        const auto& channel = capture.channels[index];
        if (channel.unit != unit) {
            return invalid("channel '{}' is in '{}'; {} is expected", channel.name, channel.unit, unit);
        }
    }
    const auto& volts = capture.channels[voltage];
    const auto& amperes = capture.channels[current];
    const auto pulses = measureChannel(capture, current, options);
    const double voltageNoise = neighbourNoise(volts.samples, volts.lsb);
    LoadMeasurement result;
    result.voltage = volts.name;
    result.current = amperes.name;
    result.pulses = loadOfPulses(capture, voltage, current, pulses);
    summariseLoad(capture.gainShared, volts, amperes, pulses, voltageNoise, result);
    warnOfLoad(pulses, result);
    warnOfFlatVoltage(capture, voltage, options, result);
    return result;
}

std::optional<std::pair<std::size_t, std::size_t>> loadChannels(const Capture& capture) {
    std::optional<std::size_t> found[2];
    for (std::size_t c = 0; c < capture.channels.size(); ++c) {
        const auto& unit = capture.channels[c].unit;
        if (unit != "V" && unit != "A") continue;
        auto& slot = found[unit == "V" ? 0 : 1];
        if (slot) return std::nullopt;
        slot = c;
    }
    if (!found[0] || !found[1]) return std::nullopt;
    return std::pair{*found[0], *found[1]};
}

}  // namespace tacto
