#include "core/analysis/LoadReading.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/measure/PulseMeasurement.h"

namespace tacto {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kSqrt3 = 1.7320508075688772;
constexpr double kSqrt12 = 3.4641016151377544;
constexpr double kFewestLsb = 10;
/// A capture's mean onset may jitter against the window's edge; a hundredth of a train is no further train.
constexpr double kWindowEdge = 0.01;

const CaptureChannel* channelOf(const Capture& capture, std::string_view name) {
    for (const auto& channel : capture.channels) {
        if (channel.name == name) return &channel;
    }
    return nullptr;
}

/// A channel's record of one train, from its own baseline.
struct Trace {
    const CaptureChannel* channel = nullptr;
    double dt = 0;
    double baseline = 0;
    double noise = 0;  ///< s.d. about the baseline
    std::size_t quiet = 0;

    [[nodiscard]] double at(std::size_t i) const { return static_cast<double>(channel->samples[i]) - baseline; }
};

/// Nothing when a sample is missing or clipped, or the record does not begin with quiet: such a record is not measured.
std::optional<Trace> traceOf(const Capture& capture, std::string_view name, double onset_s) {
    const auto* channel = channelOf(capture, name);
    if (channel == nullptr || !(capture.rate_hz > 0)) return std::nullopt;
    Trace trace{channel, 1 / capture.rate_hz, 0, 0, 0};
    for (const float sample : channel->samples) {
        if (!std::isfinite(sample)) return std::nullopt;
        if (channel->low < channel->high && (!(sample > channel->low) || !(sample < channel->high)))
            return std::nullopt;
    }
    // The last tenth before the onset is left out: an edge begins before its half height.
    const double before = 0.9 * (onset_s - capture.start_s) * capture.rate_hz;
    if (!(before >= 8)) return std::nullopt;
    trace.quiet = std::min(static_cast<std::size_t>(before), channel->samples.size());
    double sum = 0;
    for (std::size_t i = 0; i < trace.quiet; ++i) sum += static_cast<double>(channel->samples[i]);
    trace.baseline = sum / static_cast<double>(trace.quiet);
    double squares = 0;
    for (std::size_t i = 0; i < trace.quiet; ++i) squares += trace.at(i) * trace.at(i);
    trace.noise = std::sqrt(squares / static_cast<double>(trace.quiet));
    return trace;
}

struct Sums {
    double peak = 0, step = 0;
    double integral = 0, squares = 0;
};

Sums sumsOf(const Trace& trace) {
    Sums sums;
    double last = 0;
    for (std::size_t i = trace.quiet; i < trace.channel->samples.size(); ++i) {
        const double x = trace.at(i);
        if (std::abs(x) > sums.peak) {
            sums.peak = std::abs(x);
            const double next = i + 1 < trace.channel->samples.size() ? trace.at(i + 1) : x;
            // An edge into the peak is as steep as the source; what may stand higher shows in the way down.
            sums.step = std::min(std::abs(x - last), std::abs(next - x));
        }
        sums.integral += x * trace.dt;
        sums.squares += x * x * trace.dt;
        last = x;
    }
    const double seconds = static_cast<double>(trace.channel->samples.size() - trace.quiet) * trace.dt;
    sums.squares = std::max(0.0, sums.squares - trace.noise * trace.noise * seconds);  // noise squared is not signal
    return sums;
}

double energyOf(const Trace& v, const Trace& i) {
    const std::size_t first = std::max(v.quiet, i.quiet);
    const std::size_t count = std::min(v.channel->samples.size(), i.channel->samples.size());
    double sum = 0;
    for (std::size_t k = first; k < count; ++k) sum += v.at(k) * i.at(k) * v.dt;
    return sum;
}

/// Of one train, from its own capture.
struct TrainFigures {
    double onset_s = kNaN, width_s = kNaN, plateau_v = kNaN, plateau_a = kNaN;
    double peak_v = kNaN, peak_a = kNaN, step_v = 0, step_a = 0;
    double squares_v = kNaN, squares_a = kNaN, net_C = kNaN, phase_C = kNaN, energy_J = kNaN;
    double noise_v = 0, noise_a = 0;
    std::size_t plateauSamples = 1;
    bool biphasic = false;
};

void readCurrent(const Capture& capture, const MeasureOptions& options, double onset_s, int pulses, TrainFigures& out,
                 std::vector<std::string>& warnings) {
    const auto trace = traceOf(capture, "current", onset_s);
    if (!trace) {
        warnings.push_back(
            "the current of a train is missing, clipped or has no quiet stretch before it: not measured");
        return;
    }
    const Sums sums = sumsOf(*trace);
    out.peak_a = sums.peak;
    out.step_a = sums.step;
    out.squares_a = sums.squares;
    out.net_C = std::abs(sums.integral) / pulses;
    out.noise_a = trace->noise;
    if (const auto voltage = traceOf(capture, "voltage", onset_s)) out.energy_J = energyOf(*voltage, *trace) / pulses;
    const auto measured = measureTrains({&capture, 1}, "current", options);
    if (!measured || measured->measuredPulses == 0) return;
    double level = 0, phase = 0;
    std::size_t n = 0;
    for (const auto& pulse : measured->pulses) {
        if (!pulse.flags.measured()) continue;
        level += std::abs(pulse.leading.plateau);
        phase = std::max(phase, std::abs(pulse.leading.charge));
        if (pulse.second) phase = std::max(phase, std::abs(pulse.second->charge));
        ++n;
    }
    out.plateau_a = level / static_cast<double>(n);
    out.phase_C = phase;
}

std::optional<TrainFigures> readTrain(const Capture& capture, const MeasureOptions& options, int pulses,
                                      std::vector<std::string>& warnings) {
    const auto measured = measureTrains({&capture, 1}, "voltage", options);
    if (!measured || measured->measuredPulses == 0) {
        warnings.push_back("a capture holds no pulse that can be measured on the voltage channel");
        return std::nullopt;
    }
    if (static_cast<int>(measured->measuredPulses) != pulses) {
        warnings.push_back(
            fmt::format("a train has {} measured pulses; {} were commanded", measured->measuredPulses, pulses));
        return std::nullopt;
    }
    TrainFigures out;
    out.onset_s = measured->trains.front().onset_s;
    out.width_s = measured->width_s.mean;
    out.plateau_v = measured->amplitude.mean;
    out.biphasic = true;
    for (const auto& pulse : measured->pulses) {
        out.biphasic = out.biphasic && pulse.second.has_value();
        out.plateauSamples = std::max<std::size_t>(1, pulse.leading.samples / 2);
    }
    const auto trace = traceOf(capture, "voltage", out.onset_s);
    if (!trace) {
        warnings.push_back("the voltage of a train is clipped, lacks samples or has no quiet stretch before it");
        return std::nullopt;
    }
    const Sums sums = sumsOf(*trace);
    out.peak_v = sums.peak;
    out.step_v = sums.step;
    out.squares_v = sums.squares;
    out.noise_v = trace->noise;
    readCurrent(capture, options, out.onset_s, pulses, out, warnings);
    return out;
}

template <class Member>
std::vector<double> columnOf(const std::vector<TrainFigures>& trains, Member member) {
    std::vector<double> out;
    for (const auto& train : trains) out.push_back(train.*member);
    return out;
}

double meanOf(const std::vector<double>& values) { return statisticsOf(values).mean; }
/// NaN when any is: what one train did not show may have been the largest.
double largestOf(const std::vector<double>& values) {
    double most = 0;
    for (const double value : values) {
        if (std::isnan(value)) return kNaN;
        most = std::max(most, value);
    }
    return values.empty() ? kNaN : most;
}

double together(std::initializer_list<double> parts) {
    double squares = 0;
    for (const double part : parts) squares += part * part;
    return std::sqrt(squares);
}

/// Standard deviation of the mean of the trains; nothing to tell from one.
double spreadOf(const std::vector<double>& values) {
    const auto s = statisticsOf(values);
    return s.n > 1 && std::isfinite(s.sd) ? s.sd / std::sqrt(static_cast<double>(s.n)) : 0;
}

Reading timesRoot(const Reading& squares_A2s, double seconds, double scale) {
    if (!squares_A2s.measured() || !(squares_A2s.value > 0)) return squares_A2s.measured() ? Reading{0, 0} : Reading{};
    const double rms = std::sqrt(squares_A2s.value / seconds) * scale;
    return {rms, rms * 0.5 * squares_A2s.u / squares_A2s.value};
}

Reading times(double factor, const Reading& reading) { return {factor * reading.value, factor * reading.u}; }

}  // namespace

bool Reading::measured() const noexcept { return std::isfinite(value) && std::isfinite(u); }

Result<LoadReading> readLoad(std::span<const Capture> captures, const ExpectedTrain& expected) {
    if (captures.empty()) return fail(ErrorCode::InvalidArgument, "no capture to read a load from; one per train");
    if (expected.pulses < 1 || !(expected.rate_hz > 0) || !(expected.interval_s > 0)) {
        return fail(ErrorCode::InvalidArgument,
                    "a train of {} pulses at {} Hz every {} s; 1 or more, above 0 and above 0 are expected",
                    expected.pulses, expected.rate_hz, expected.interval_s);
    }
    const auto* voltage = channelOf(captures.front(), "voltage");
    if (voltage == nullptr) return fail(ErrorCode::NotFound, "the capture has no channel \"voltage\"");
    const auto* current = channelOf(captures.front(), "current");

    MeasureOptions options;
    if (expected.pulses > 1) options.intraTrainRate = Hertz(expected.rate_hz);
    LoadReading out;
    std::vector<TrainFigures> trains;
    for (const auto& capture : captures) {
        if (auto train = readTrain(capture, options, expected.pulses, out.warnings)) trains.push_back(*train);
    }
    out.trains = trains.size();
    // One train that cannot be read may have been the one above a limit.
    if (trains.size() != captures.size()) return out;

    const double gain_v = voltage->gainTolerance / kSqrt3;
    const double gain_i = current != nullptr ? current->gainTolerance / kSqrt3 : 0;
    const double lsb_v = voltage->lsb / kSqrt12;
    const double lsb_a = current != nullptr ? current->lsb / kSqrt12 : 0;
    const double dt = 1 / captures.front().rate_hz;
    const auto n = static_cast<double>(trains.size());
    out.biphasic = std::all_of(trains.begin(), trains.end(), [](const auto& train) { return train.biphasic; });
    out.currentLsb = current != nullptr ? current->lsb : 0;

    const auto volts = columnOf(trains, &TrainFigures::plateau_v);
    const auto amps = columnOf(trains, &TrainFigures::plateau_a);
    const auto widths = columnOf(trains, &TrainFigures::width_s);
    const double v = meanOf(volts), a = meanOf(amps), w = meanOf(widths);
    const double samples = static_cast<double>(trains.front().plateauSamples);
    const double noise_v = trains.front().noise_v / std::sqrt(samples * n);
    const double noise_a = trains.front().noise_a / std::sqrt(samples * n);
    // A difference of two levels, each known to a step of the converter.
    out.amplitude_v = {v, together({gain_v * v, lsb_v * std::sqrt(2.0), noise_v, spreadOf(volts)})};
    out.width_s = {w, together({dt / std::sqrt(6.0), spreadOf(widths)})};
    out.peak_v = {largestOf(columnOf(trains, &TrainFigures::peak_v)), 0};
    out.peak_v.u = together({gain_v * out.peak_v.value, lsb_v * std::sqrt(2.0), trains.front().noise_v,
                             largestOf(columnOf(trains, &TrainFigures::step_v)) / kSqrt12});

    if (trains.size() > 1) {
        double shortest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 1; k < trains.size(); ++k) {
            shortest = std::min(shortest, trains[k].onset_s - trains[k - 1].onset_s);
        }
        out.interval_s = shortest > 0 ? Reading{shortest, dt / std::sqrt(3.0)} : Reading{};
    }
    // A train is one of ⌈window / interval⌉ that the worst window holds.
    const auto inWindow = [&](double seconds) {
        if (!out.interval_s.measured()) return kNaN;
        return std::max(1.0, std::ceil(seconds / out.interval_s.value - kWindowEdge));
    };
    const double squares_v = largestOf(columnOf(trains, &TrainFigures::squares_v));
    const double relative_v = v > 0 ? out.amplitude_v.u / v : kNaN;
    const Reading train_v{squares_v, 2 * squares_v * together({relative_v, 0.5 * out.width_s.u / w})};
    out.rms_5s_v = timesRoot(times(inWindow(5), train_v), 5, 1);

    if (!std::isfinite(a) || current == nullptr) {
        out.warnings.push_back("the current was not measured");
        return out;
    }
    if (!(current->lsb > 0) || !(a >= kFewestLsb * current->lsb)) {
        out.underTenLsb = true;
        out.warnings.push_back(fmt::format("the current of {:.3g} mA is below 10 LSB of {:.3g} mA: not evaluated",
                                           1e3 * a, 1e3 * current->lsb));
        return out;
    }
    const double u_a = together({gain_i * a, lsb_a * std::sqrt(2.0), noise_a, spreadOf(amps)});
    out.amplitude_ma = {1e3 * a, 1e3 * u_a};
    out.impedance_ohm = {v / a, v / a * together({relative_v, u_a / a})};
    const double peak_a = largestOf(columnOf(trains, &TrainFigures::peak_a));
    out.peak_ma = {1e3 * peak_a, 1e3 * together({gain_i * peak_a, lsb_a * std::sqrt(2.0), trains.front().noise_a,
                                                 largestOf(columnOf(trains, &TrainFigures::step_a)) / kSqrt12})};
    const double phase = largestOf(columnOf(trains, &TrainFigures::phase_C));
    const double net = largestOf(columnOf(trains, &TrainFigures::net_C));
    // Gain is common to both phases and leaves their balance alone; what a converter's steps hide in two plateaus and
    // in the baseline under them does not.
    const double record_s = static_cast<double>(captures.front().samples()) * dt;
    const double u_net = together({lsb_a * w * std::sqrt(6.0), trains.front().noise_a * std::sqrt(record_s * dt),
                                   spreadOf(columnOf(trains, &TrainFigures::net_C))});
    out.charge_uc = {1e6 * phase,
                     1e6 * together({gain_i * phase, lsb_a * w * std::sqrt(2.0), phase * out.width_s.u / w})};
    out.net_charge_uc = {1e6 * net, 1e6 * together({gain_i * net, u_net})};
    out.imbalance = {net / phase, u_net / phase};
    const double energy = largestOf(columnOf(trains, &TrainFigures::energy_J));
    const double relative_i = u_a / a;
    const double u_energy = energy * together({relative_v, relative_i, out.width_s.u / w});
    out.energy_mj = {1e3 * energy, 1e3 * u_energy};
    const double squares = largestOf(columnOf(trains, &TrainFigures::squares_a));
    const Reading train_a{squares, 2 * squares * together({relative_i, 0.5 * out.width_s.u / w})};
    out.rms_train_ma = timesRoot(train_a, expected.pulses / expected.rate_hz, 1e3);
    out.rms_1s_ma = timesRoot(times(inWindow(1), train_a), 1, 1e3);
    out.rms_5s_ma = timesRoot(times(inWindow(5), train_a), 5, 1e3);
    out.dc_ma = times(inWindow(5) * expected.pulses / 5 * 1e-3, out.net_charge_uc);
    out.power_1s_w = times(inWindow(1) * expected.pulses * 1e-3, out.energy_mj);
    return out;
}

}  // namespace tacto
