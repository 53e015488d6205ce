#include "core/analysis/LoadReading.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/LoadTrace.h"
#include "core/base/NaN.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto {

namespace {

constexpr double kSqrt2 = 1.4142135623730951;
constexpr double kSqrt3 = 1.7320508075688772;
constexpr double kSqrt12 = 3.4641016151377544;
constexpr double kFewestLsb = 10;
/// An onset may jitter against the window's edge; a hundredth of a train is no further train.
constexpr double kWindowEdge = 0.01;
constexpr double kEndFrom = 0.80, kEndTo = 0.97;  // of the leading phase: where |Z| is read
/// Of a straight line that is followed from there to the end: the noise of its value over that of the mean, and the
/// share of the way that a bend may be worth.
constexpr double kLineNoise = 2.6, kLineDoubt = 0.2;

/// Of one train, from its own capture. SI units; NaN where not measured.
struct TrainFigures {
    double onset_s = kNaN, width_s = kNaN, plateau_v = kNaN, end_v = kNaN, end_a = kNaN;
    double peak_v = kNaN, peak_a = kNaN, step_v = 0, step_a = 0;
    double magnitude_v = 0, magnitude_a = 0;
    double squares_v = kNaN, squares_a = kNaN, net_C = kNaN, phase_C = kNaN, energy_J = kNaN;
    double line_v = 0;  ///< how far the voltage was followed from where it was read
    double impedance = kNaN, delivered = kNaN;
    double noise_v = 0, noise_a = 0;
    double endSamples = 1;
    bool biphasic = false;
};

/// The channel that the source drives.
std::string_view drivenBy(const ExpectedTrain& expected) {
    return expected.drive == Drive::Current ? "current" : "voltage";
}

/// The pulses of a train by what is driven; nothing, with a warning, unless all of them are measured.
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

std::optional<TrainFigures> readTrain(const Capture& capture, const ExpectedTrain& expected, double told,
                                      std::vector<std::string>& warnings) {
    const auto pulses = pulsesOf(capture, expected, warnings);
    if (!pulses) return std::nullopt;
    TrainFigures out;
    out.onset_s = pulses->trains.front().onset_s;
    out.width_s = pulses->width_s.mean;
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
    out.delivered = (expected.drive == Drive::Voltage ? out.plateau_v : 1e3 * out.end_a) / told;
    return out;
}

using Trains = std::vector<TrainFigures>;

std::vector<double> columnOf(const Trains& trains, double TrainFigures::*member) {
    std::vector<double> out;
    for (const auto& train : trains) out.push_back(train.*member);
    return out;
}

double meanOver(const Trains& trains, double TrainFigures::*member) {
    return statisticsOf(columnOf(trains, member)).mean;
}

/// NaN when any is: what one train did not show may have been the largest.
double largestOf(const Trains& trains, double TrainFigures::*member) {
    double most = 0;
    for (const auto& train : trains) {
        if (std::isnan(train.*member)) return kNaN;
        most = std::max(most, train.*member);
    }
    return most;
}

double together(std::initializer_list<double> parts) {
    double squares = 0;
    for (const double part : parts) squares += part * part;
    return std::sqrt(squares);
}

/// Standard deviation of the mean of the trains; one train has none to tell.
double spreadOf(const Trains& trains, double TrainFigures::*member) {
    const auto s = statisticsOf(columnOf(trains, member));
    return s.n > 1 && std::isfinite(s.sd) ? s.sd / std::sqrt(static_cast<double>(s.n)) : 0;
}

Reading rootOf(const Reading& squares, double seconds, double scale) {
    if (!squares.measured()) return {};
    if (!(squares.value > 0)) return {0, 0};
    const double rms = std::sqrt(squares.value / seconds) * scale;
    return {rms, rms * 0.5 * squares.u / squares.value};
}

Reading times(double factor, const Reading& reading) { return {factor * reading.value, factor * reading.u}; }

/// What a channel's data sheet and record say, k = 1.
struct ChannelDoubt {
    double gain = 0;   ///< relative
    double level = 0;  ///< of a level above the baseline: two of them, each to a step of the converter
    explicit ChannelDoubt(const CaptureChannel* channel)
        : gain(channel != nullptr ? channel->gainTolerance / kSqrt3 : 0),
          level(channel != nullptr ? channel->lsb / kSqrt12 * kSqrt2 : 0) {}
};

/// Of the voltage at the end of a phase, noise and the way there; `samples` were averaged.
double endDoubt(const Trains& trains, double samples) {
    const double line = meanOver(trains, &TrainFigures::line_v);
    return together(
        {(line > 0 ? kLineNoise : 1) * trains.front().noise_v / std::sqrt(samples), kLineDoubt * line / kSqrt3});
}

Reading impedanceOf(const Trains& trains, const ChannelDoubt& v, const ChannelDoubt& i, double currentLsb) {
    const double volts = meanOver(trains, &TrainFigures::end_v), amps = meanOver(trains, &TrainFigures::end_a);
    if (!(currentLsb > 0) || !(amps >= kFewestLsb * currentLsb)) return {};
    const double samples = trains.front().endSamples * static_cast<double>(trains.size());
    const double u_v = together({v.gain * volts, v.level, endDoubt(trains, samples)});
    const double u_a = together({i.gain * amps, i.level, trains.front().noise_a / std::sqrt(samples)});
    return {volts / amps, together({volts / amps * u_v / volts, volts / amps * u_a / amps,
                                    spreadOf(trains, &TrainFigures::impedance)})};
}

/// The mean of the trains, each in doubt by `u` of it: their spread is that of what they were told as well.
void addAmplitude(LoadReading& out, Reading& amplitude, const Trains& trains, double TrainFigures::*member, double u,
                  bool driven) {
    const double mean = meanOver(trains, member);
    amplitude = {mean, together({u, spreadOf(trains, member)})};
    if (!driven) return;
    const double ratio = meanOver(trains, &TrainFigures::delivered);
    out.delivered = {ratio, together({ratio * u / mean, spreadOf(trains, &TrainFigures::delivered)})};
}

void addVoltage(LoadReading& out, const Trains& trains, Drive drive, const ChannelDoubt& doubt, double dt) {
    const double v = meanOver(trains, &TrainFigures::plateau_v), w = meanOver(trains, &TrainFigures::width_s);
    const double u = together({doubt.gain * v, doubt.level, endDoubt(trains, trains.front().endSamples)});
    addAmplitude(out, out.amplitude_v, trains, &TrainFigures::plateau_v, u, drive == Drive::Voltage);
    const double highest = largestOf(trains, &TrainFigures::plateau_v);
    out.highest_v = {highest, u * highest / v};
    out.width_s = {w, together({dt / std::sqrt(6.0), spreadOf(trains, &TrainFigures::width_s)})};
    const double peak = largestOf(trains, &TrainFigures::peak_v);
    out.peak_v = {peak, together({doubt.gain * peak, doubt.level, trains.front().noise_v,
                                  largestOf(trains, &TrainFigures::step_v) / kSqrt12})};
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < trains.size(); ++k) {
        shortest = std::min(shortest, trains[k].onset_s - trains[k - 1].onset_s);
    }
    if (std::isfinite(shortest) && shortest > 0) out.interval_s = {shortest, dt / kSqrt3};
}

/// Trains that the worst window of `seconds` holds; NaN without an interval.
double trainsIn(double seconds, const Reading& interval_s) {
    if (!interval_s.measured()) return kNaN;
    return std::max(1.0, std::ceil(seconds / interval_s.value - kWindowEdge));
}

void addCurrent(LoadReading& out, const Trains& trains, const ExpectedTrain& expected, const ChannelDoubt& v,
                const ChannelDoubt& i, double dt, double record_s) {
    const double amps = meanOver(trains, &TrainFigures::end_a);
    const double noise = trains.front().noise_a;
    addAmplitude(out, out.amplitude_ma, trains, &TrainFigures::end_a, together({i.gain * amps, i.level}),
                 expected.drive == Drive::Current);
    out.amplitude_ma = times(1e3, out.amplitude_ma);
    out.impedance_ohm = impedanceOf(trains, v, i, out.currentLsb);
    const double peak = largestOf(trains, &TrainFigures::peak_a);
    out.peak_ma = times(
        1e3, {peak, together({i.gain * peak, i.level, noise, largestOf(trains, &TrainFigures::step_a) / kSqrt12})});

    const double w = out.width_s.value, wide = out.width_s.u / w;
    const double phase = largestOf(trains, &TrainFigures::phase_C);
    const double net = largestOf(trains, &TrainFigures::net_C);
    // Gain is common to both phases and leaves their balance alone; what the converter's steps hide in two plateaus
    // and in the baseline under them does not.
    const double u_net =
        together({i.level * w * kSqrt3, noise * std::sqrt(record_s * dt), spreadOf(trains, &TrainFigures::net_C)});
    out.charge_uc = times(1e6, {phase, together({i.gain * phase, i.level * w, phase * wide})});
    out.net_charge_uc = times(1e6, {net, together({i.gain * net, u_net})});
    out.imbalance = {net / phase, u_net / phase};
    const double energy = largestOf(trains, &TrainFigures::energy_J);
    const double pulses = expected.pulses;
    out.energy_mj = times(1e3, {energy, together({v.gain * energy, i.gain * energy, energy * wide,
                                                  v.level * largestOf(trains, &TrainFigures::magnitude_a) / pulses,
                                                  i.level * largestOf(trains, &TrainFigures::magnitude_v) / pulses})});
    const double squares = largestOf(trains, &TrainFigures::squares_a);
    const Reading train{
        squares,
        together({2 * i.gain * squares, 2 * i.level * largestOf(trains, &TrainFigures::magnitude_a), squares * wide})};
    out.rms_train_ma = rootOf(train, pulses / expected.rate_hz, 1e3);
    out.rms_1s_ma = rootOf(times(trainsIn(1, out.interval_s), train), 1, 1e3);
    out.rms_5s_ma = rootOf(times(trainsIn(5, out.interval_s), train), 5, 1e3);
    out.dc_ma = times(trainsIn(5, out.interval_s) * pulses / 5 * 1e-3, out.net_charge_uc);
    out.power_1s_w = times(trainsIn(1, out.interval_s) * pulses * 1e-3, out.energy_mj);
}

/// A wide and a fine record of the same command, each known by the onset of its first pulse.
struct TwoRanges {
    LoadTrace wide, fine, voltage;  ///< voltage: of the fine record
    double wideOnset_s = 0, fineOnset_s = 0;
    ChannelMeasurement pulses;  ///< of the fine record
};

std::optional<TwoRanges> twoRanges(const Capture& wide, const Capture& fine, const ExpectedTrain& expected,
                                   std::vector<std::string>& warnings) {
    const auto wideOnset = pulsesOf(wide, expected, warnings);
    auto pulses = pulsesOf(fine, expected, warnings);
    if (!wideOnset || !pulses) return std::nullopt;
    const double wide_s = wideOnset->trains.front().onset_s, fine_s = pulses->trains.front().onset_s;
    const auto a = traceOf(wide, "current", wide_s), b = traceOf(fine, "current", fine_s);
    const auto v = traceOf(fine, "voltage", fine_s);
    if (!a || a->clipped || !b || !v || v->clipped) return std::nullopt;
    return TwoRanges{*a, *b, *v, wide_s, fine_s, std::move(*pulses)};
}

/// ∫i of the fine record, and of the wide one while the fine one clips; with how long that was, and how often.
struct Joined {
    double integral = 0, wide_s = 0;
    std::size_t seams = 0;
};
Joined joined(const TwoRanges& two) {
    constexpr std::size_t kAside = 3;  // samples beside a clipped one: its amplifier is still coming back
    Joined out;
    const auto& fine = two.fine;
    for (std::size_t i = fine.quiet; i < fine.size();) {
        std::size_t end = i;
        while (end < fine.size() && !fine.clippedNear(end, kAside)) out.integral += fine.at(end++) * fine.dt;
        i = end;
        while (end < fine.size() && fine.clippedNear(end, kAside)) ++end;
        if (end == i) break;
        const double shift = two.wideOnset_s - two.fineOnset_s;
        const double from = fine.start_s + static_cast<double>(i) * fine.dt + shift;
        const double to = fine.start_s + static_cast<double>(end) * fine.dt + shift;
        out.integral += integralOf(two.wide, from, to);
        out.wide_s += to - from;
        out.seams += 2;
        i = end;
    }
    return out;
}

void addFine(LoadReading& out, std::span<const Capture> captures, std::span<const Capture> fine,
             const ExpectedTrain& expected) {
    out.impedance_ohm = out.net_charge_uc = out.imbalance = {};
    Trains ends;
    double net = 0, u_net = 0;
    for (std::size_t k = 0; k < fine.size(); ++k) {
        const auto two = twoRanges(captures[k % captures.size()], fine[k], expected, out.warnings);
        if (!two) return;
        TrainFigures figures;
        readEnds(two->voltage, &two->fine, two->pulses, expected.drive, figures);
        figures.noise_v = two->voltage.noise;
        figures.noise_a = two->fine.noise;
        if (!(figures.end_a < 0.98 * two->fine.channel->high)) return;  // the range does not fit the end either
        ends.push_back(figures);
        const auto charge = joined(*two);
        net = std::max(net, std::abs(charge.integral) / expected.pulses);
        // A moving level takes every step of the converter alike; what stays is that of the baseline under it.
        const double w = out.width_s.value;
        u_net = std::max(u_net, together({two->wide.channel->lsb / kSqrt12 * charge.wide_s / expected.pulses,
                                          ChannelDoubt(two->fine.channel).level * w * kSqrt3,
                                          two->fine.channel->high * two->fine.dt / kSqrt12 *
                                              std::sqrt(static_cast<double>(charge.seams)),
                                          two->wide.noise * std::sqrt(charge.wide_s * two->wide.dt)}));
    }
    const auto* current = channelOf(fine.front(), "current");
    out.impedance_ohm =
        impedanceOf(ends, ChannelDoubt(channelOf(fine.front(), "voltage")), ChannelDoubt(current), current->lsb);
    const double phase = 1e-6 * out.charge_uc.value;
    out.net_charge_uc = times(1e6, {net, together({ChannelDoubt(current).gain * net, u_net})});
    out.imbalance = {net / phase, u_net / phase};
}

Result<void> checked(std::span<const Capture> captures, const ExpectedTrain& expected) {
    if (captures.empty()) return fail(ErrorCode::InvalidArgument, "no capture to read a load from; one per train");
    if (expected.pulses < 1 || !(expected.rate_hz > 0)) {
        return fail(ErrorCode::InvalidArgument, "a train of {} pulses at {} Hz; at least 1 and above 0 are expected",
                    expected.pulses, expected.rate_hz);
    }
    if (!expected.told.empty() && expected.told.size() != captures.size()) {
        return fail(ErrorCode::InvalidArgument, "{} amplitudes told for {} captures; one for each is expected",
                    expected.told.size(), captures.size());
    }
    for (const auto needed : {std::string_view("voltage"), drivenBy(expected)}) {
        if (channelOf(captures.front(), needed) != nullptr) continue;
        return fail(ErrorCode::NotFound, "the capture has no channel \"{}\"", needed);
    }
    return {};
}

}  // namespace

bool Reading::measured() const noexcept { return std::isfinite(value) && std::isfinite(u); }

Result<LoadReading> readLoad(std::span<const Capture> captures, const ExpectedTrain& expected,
                             std::span<const Capture> fine) {
    if (const auto sane = checked(captures, expected); !sane) return failure(sane);
    LoadReading out;
    Trains trains;
    for (std::size_t k = 0; k < captures.size(); ++k) {
        const double told = expected.told.empty() ? kNaN : expected.told[k];
        if (auto train = readTrain(captures[k], expected, told, out.warnings)) trains.push_back(*train);
    }
    out.trains = trains.size();
    // One train that cannot be read may have been the one above a limit.
    if (trains.size() != captures.size()) return out;

    const auto* current = channelOf(captures.front(), "current");
    const ChannelDoubt v(channelOf(captures.front(), "voltage")), i(current);
    const double dt = 1 / captures.front().rate_hz;
    out.biphasic = std::all_of(trains.begin(), trains.end(), [](const auto& train) { return train.biphasic; });
    out.currentLsb = current != nullptr ? current->lsb : 0;
    addVoltage(out, trains, expected.drive, v, dt);
    const double squares = largestOf(trains, &TrainFigures::squares_v);
    const Reading train{squares,
                        together({2 * v.gain * squares, 2 * v.level * largestOf(trains, &TrainFigures::magnitude_v),
                                  squares * out.width_s.u / out.width_s.value})};
    out.rms_5s_v = rootOf(times(trainsIn(5, out.interval_s), train), 5, 1);

    const double peak = largestOf(trains, &TrainFigures::peak_a);
    if (!std::isfinite(peak)) return out;
    if (!(out.currentLsb > 0) || !(peak >= kFewestLsb * out.currentLsb)) {
        out.underTenLsb = true;
        out.warnings.push_back(fmt::format("the current of {:.3g} mA is below 10 LSB of {:.3g} mA: not evaluated",
                                           1e3 * peak, 1e3 * out.currentLsb));
        return out;
    }
    addCurrent(out, trains, expected, v, i, dt, static_cast<double>(captures.front().samples()) * dt);
    if (!fine.empty()) addFine(out, captures, fine, expected);
    return out;
}

}  // namespace tacto
