#include "core/analysis/load_safety/LoadTrain.h"

#include <algorithm>
#include <cmath>

namespace tacto {

namespace {

constexpr double kEndFrom = 0.80, kEndTo = 0.97;  // share of the leading phase in which |Z| is read

void readCurrent(const LoadTrace& voltage, const LoadTrace& current, const ChannelMeasurement& pulses,
                 TrainFigures& out) {
    const auto sums = sumsOf(current);
    const auto n = static_cast<double>(pulses.pulses.size());
    out.peak_a = sums.peak;
    out.step_a = sums.step;
    out.magnitude_a = sums.magnitude;
    out.squares_a = sums.squares;
    out.net_C = std::abs(sums.integral) / n;
    out.noise_a = current.noise;
    out.energy_J = energyOf(voltage, current) / n;
    out.phase_C = 0;
    for (const auto& pulse : pulses.pulses) {
        const auto chargeOf = [&](const PhaseMeasurement& phase) {
            return std::abs(integralOf(current, phase.onset_s, phase.end_s));
        };
        out.phase_C = std::max(out.phase_C, chargeOf(pulse.leading));
        if (pulse.second) out.phase_C = std::max(out.phase_C, chargeOf(*pulse.second));
    }
}

}  // namespace

std::string_view drivenBy(const ExpectedTrain& expected) {
    return expected.drive == Drive::Current ? "current" : "voltage";
}

std::optional<ChannelMeasurement> pulsesOf(const Capture& capture, const ExpectedTrain& expected,
                                           std::vector<std::string>& warnings) {
    MeasureOptions options;
    if (expected.pulses > 1) options.intraTrainRate = Hertz(expected.rate_hz);
    auto measured = measureTrains({&capture, 1}, drivenBy(expected), options);
    if (!measured) {
        warnings.push_back(measured.error().message);
        return std::nullopt;
    }
    if (measured->measuredPulses == static_cast<std::size_t>(expected.pulses) &&
        measured->pulses.size() == measured->measuredPulses) {
        return std::move(*measured);
    }
    warnings.push_back(fmt::format("a train shows {} pulses on the {} channel, {} of them measured; {} were commanded",
                                   measured->pulses.size(), drivenBy(expected), measured->measuredPulses,
                                   expected.pulses));
    for (auto& why : measured->warnings) warnings.push_back(std::move(why));
    return std::nullopt;
}

void readEnds(const LoadTrace& voltage, const LoadTrace* current, const ChannelMeasurement& pulses, Drive drive,
              TrainFigures& out) {
    double v = 0, a = 0, line = 0;
    for (const auto& pulse : pulses.pulses) {
        const double from = pulse.leading.onset_s + kEndFrom * pulse.leading.width_s;
        const double to = pulse.leading.onset_s + kEndTo * pulse.leading.width_s;
        const double mean = meanOf(voltage, from, to);
        const double end = drive == Drive::Current ? lineAt(voltage, from, to, pulse.leading.end_s) : mean;
        v += std::abs(end);
        line += std::abs(end - mean);
        if (current != nullptr) a += std::abs(meanOf(*current, from, to));
        out.endSamples = std::max(1.0, (to - from) / voltage.dt);
    }
    const auto n = static_cast<double>(pulses.pulses.size());
    out.end_v = v / n;
    out.line_v = line / n;
    if (current != nullptr) out.end_a = a / n;
    out.impedance = out.end_v / out.end_a;
}

std::optional<TrainFigures> readTrain(const Capture& capture, const ExpectedTrain& expected, double programmed,
                                      std::vector<std::string>& warnings) {
    const auto pulses = pulsesOf(capture, expected, warnings);
    if (!pulses) return std::nullopt;
    TrainFigures out;
    out.onset_s = pulses->trains.front().onset_s;
    out.width_s = pulses->width_s.mean;
    if (const auto spaces = pulses->pulses.size() - 1; spaces > 0) {
        const double first_s = pulses->pulses.front().leading.onset_s, last_s = pulses->pulses.back().leading.onset_s;
        out.rate_hz = static_cast<double>(spaces) / (last_s - first_s);
    }
    out.biphasic = std::all_of(pulses->pulses.begin(), pulses->pulses.end(),
                               [](const auto& pulse) { return pulse.second.has_value(); });
    const auto voltage = traceOf(capture, "voltage", out.onset_s);
    if (!voltage || voltage->clipped) {
        warnings.emplace_back("the voltage of a train is clipped, lacks samples or has no quiet stretch before it");
        return std::nullopt;
    }
    const auto sums = sumsOf(*voltage);
    out.peak_v = sums.peak;
    out.step_v = sums.step;
    out.magnitude_v = sums.magnitude;
    out.squares_v = sums.squares;
    out.noise_v = voltage->noise;
    const auto current = traceOf(capture, "current", out.onset_s);
    if (current && !current->clipped) {
        readCurrent(*voltage, *current, *pulses, out);
        readEnds(*voltage, &*current, *pulses, expected.drive, out);
    } else {
        warnings.emplace_back("the current of a train is missing, clipped or has no quiet stretch before it");
        readEnds(*voltage, nullptr, *pulses, expected.drive, out);
    }
    out.plateau_v = expected.drive == Drive::Voltage ? pulses->amplitude.mean : out.end_v;
    out.delivered = (expected.drive == Drive::Voltage ? out.plateau_v : 1e3 * out.end_a) / programmed;
    return out;
}

Statistics statisticsOver(const LoadTrains& trains, double TrainFigures::*member) {
    std::vector<double> readings;
    for (const auto& train : trains) readings.push_back(train.*member);
    return statisticsOf(readings);
}

double meanOver(const LoadTrains& trains, double TrainFigures::*member) { return statisticsOver(trains, member).mean; }

double largestOf(const LoadTrains& trains, double TrainFigures::*member) {
    double most = 0;
    for (const auto& train : trains) {
        if (std::isnan(train.*member)) return kNaN;
        most = std::max(most, train.*member);
    }
    return most;
}

}  // namespace tacto
