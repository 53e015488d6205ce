#include "core/analysis/LoadReading.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/LoadTrain.h"
#include "core/base/NaN.h"
#include "core/measure/InstrumentStatement.h"

namespace tacto {

namespace {

constexpr double kSqrt2 = 1.4142135623730951;
constexpr double kSqrt3 = 1.7320508075688772;
constexpr double kSqrt12 = 3.4641016151377544;
constexpr double kFewestLsb = 10;
/// An onset may jitter against the window's edge; a hundredth of a train is no further train.
constexpr double kWindowEdge = 0.01;
/// Of a straight line that is followed from there to the end: the noise of its value over that of the mean, and the
/// share of the way that a bend may be worth.
constexpr double kLineNoise = 2.6, kLineDoubt = 0.2;

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

using Rows = std::vector<Contribution>;

/// Rows of what is stated of a channel; what is not stated is NaN and makes the figure's U unknown.
struct ChannelDoubt {
    explicit ChannelDoubt(const CaptureChannel* channel) : channel_(channel) {}

    [[nodiscard]] double gain() const { return channel_ != nullptr ? channel_->gainTolerance : kNaN; }
    [[nodiscard]] double resolution() const { return channel_ != nullptr && channel_->lsb > 0 ? channel_->lsb : kNaN; }
    /// Gain and probe or shunt; `sensitivity`: the figure's change per relative change of the channel.
    void addGain(Rows& rows, double sensitivity) const {
        add(rows, "gain of " + name(), gain(), kSqrt3, sensitivity);
        addProbe(rows, sensitivity);
    }
    void addProbe(Rows& rows, double sensitivity) const {
        add(rows, (name() == "current" ? "shunt of " : "probe of ") + name(),
            channel_ != nullptr ? channel_->probeTolerance : kNaN, kSqrt3, sensitivity);
    }
    /// Of a level above the baseline: two of them, each to a step of the converter.
    void addLevel(Rows& rows, double sensitivity) const {
        add(rows, "resolution of " + name(), resolution(), kSqrt12 / kSqrt2, sensitivity);
        add(rows, "linearity of " + name(), channel_ != nullptr ? channel_->linearityTolerance : 0, kSqrt3,
            sensitivity);
    }

private:
    [[nodiscard]] std::string name() const { return channel_ != nullptr ? channel_->name : "current"; }
    static void add(Rows& rows, std::string what, double value, double divisor, double sensitivity) {
        if (value == 0) return;  // stated to be nothing
        rows.push_back({std::move(what), Distribution::Rectangular, value, divisor, sensitivity});
    }
    const CaptureChannel* channel_;
};

void addNormal(Rows& rows, const char* what, double u, double sensitivity = 1) {
    rows.push_back({what, Distribution::Normal, u, 1, sensitivity});
}

/// Of the mean of the trains; one train has no spread to tell.
void addSpread(Rows& rows, const Trains& trains, double TrainFigures::*member, double sensitivity = 1) {
    const auto s = statisticsOf(columnOf(trains, member));
    if (s.n < 2) return;
    rows.push_back({"spread of the trains", Distribution::Student, s.sd, std::sqrt(static_cast<double>(s.n)),
                    sensitivity, static_cast<double>(s.n - 1)});
}

Reading times(double factor, const Reading& reading) {
    return {factor * reading.value, std::abs(factor) * reading.u, std::abs(factor) * reading.expanded};
}

Reading rootOf(const Reading& squares, double seconds, double scale) {
    if (std::isnan(squares.value) || std::isnan(seconds)) return {};
    if (!(squares.value > 0)) return {0, 0, 0};
    const double rms = std::sqrt(squares.value / seconds) * scale;
    const double half = rms * 0.5 / squares.value;
    return {rms, half * squares.u, half * squares.expanded};
}

/// Figures of the trains of one load, one after the other.
class Evaluation {
public:
    Evaluation(const Trains& trains, const ExpectedTrain& expected, const Capture& capture)
        : trains_(trains),
          expected_(expected),
          current_(channelOf(capture, "current")),
          v_(channelOf(capture, "voltage")),
          i_(current_),
          dt_(1 / capture.rate_hz),
          record_s_(static_cast<double>(capture.samples()) * dt_),
          timeBase_(capture.timeBaseTolerance),
          stamp_s_(capture.stampTolerance_s) {}

    void addVoltage(LoadReading& out) const;
    void addInterval(LoadReading& out, const Capture* rhythm) const;
    void addVoltageWindows(LoadReading& out) const;
    void addCurrent(LoadReading& out) const;
    [[nodiscard]] Reading impedanceOf(const Trains& trains, const ChannelDoubt& v, const ChannelDoubt& i,
                                      double currentLsb) const;
    [[nodiscard]] Reading figure(double value, Rows rows) const {
        return readingOf(value, std::move(rows), expected_.budget);
    }

private:
    void addTimeBase(Rows& rows, double sensitivity) const {
        rows.push_back({"time base", Distribution::Rectangular, timeBase_, kSqrt3, sensitivity});
    }
    /// Of a width, relative: what it adds to charges, energies and squares. The time base is in all of them alike.
    void addWidth(Rows& rows, double sensitivity) const {
        addTimeBase(rows, sensitivity);
        addNormal(rows, "sampling of the edges", dt_ / std::sqrt(6.0) / meanOver(trains_, &TrainFigures::width_s),
                  sensitivity);
    }
    void addEnd(Rows& rows, const Trains& trains, double samples, double sensitivity) const;
    void addAmplitude(LoadReading& out, Reading& amplitude, double TrainFigures::*member, const Rows& rows,
                      bool driven) const;

    const Trains& trains_;
    const ExpectedTrain& expected_;
    const CaptureChannel* current_;
    const ChannelDoubt v_, i_;
    const double dt_, record_s_, timeBase_, stamp_s_;
};

/// Of the voltage at the end of a phase: noise, and the way there; `samples` were averaged.
void Evaluation::addEnd(Rows& rows, const Trains& trains, double samples, double sensitivity) const {
    const double line = meanOver(trains, &TrainFigures::line_v);
    addNormal(rows, "noise of voltage", (line > 0 ? kLineNoise : 1) * trains.front().noise_v / std::sqrt(samples),
              sensitivity);
    if (line > 0) {
        rows.push_back({"way to the phase's end", Distribution::Rectangular, kLineDoubt * line, kSqrt3, sensitivity});
    }
}

Reading Evaluation::impedanceOf(const Trains& trains, const ChannelDoubt& v, const ChannelDoubt& i,
                                double currentLsb) const {
    const double volts = meanOver(trains, &TrainFigures::end_v), amps = meanOver(trains, &TrainFigures::end_a);
    if (!(currentLsb > 0) || !(amps >= kFewestLsb * currentLsb)) return {};
    const double samples = trains.front().endSamples * static_cast<double>(trains.size());
    const double ohms = volts / amps;
    Rows rows;
    v.addGain(rows, ohms);
    i.addGain(rows, ohms);
    v.addLevel(rows, 1 / amps);
    i.addLevel(rows, ohms / amps);
    addEnd(rows, trains, samples, 1 / amps);
    addNormal(rows, "noise of current", trains.front().noise_a / std::sqrt(samples), ohms / amps);
    addSpread(rows, trains, &TrainFigures::impedance);
    return figure(ohms, std::move(rows));
}

/// The mean of the trains, each in doubt by `rows`: their spread is that of what they were told as well.
void Evaluation::addAmplitude(LoadReading& out, Reading& amplitude, double TrainFigures::*member, const Rows& rows,
                              bool driven) const {
    const double mean = meanOver(trains_, member);
    Rows all = rows;
    addSpread(all, trains_, member);
    amplitude = figure(mean, std::move(all));
    if (!driven) return;
    const double ratio = meanOver(trains_, &TrainFigures::delivered);
    all = rows;
    for (auto& row : all) row.sensitivity *= ratio / mean;
    addSpread(all, trains_, &TrainFigures::delivered);
    out.delivered = figure(ratio, std::move(all));
}

void Evaluation::addVoltage(LoadReading& out) const {
    const double v = meanOver(trains_, &TrainFigures::plateau_v);
    Rows rows;
    v_.addGain(rows, v);
    v_.addLevel(rows, 1);
    addEnd(rows, trains_, trains_.front().endSamples, 1);
    addAmplitude(out, out.amplitude_v, &TrainFigures::plateau_v, rows, expected_.drive == Drive::Voltage);
    // Of the train with the most: what the trains differ by is no doubt about it.
    const double highest = largestOf(trains_, &TrainFigures::plateau_v);
    for (auto& row : rows) row.sensitivity *= highest / v;
    out.highest_v = figure(highest, std::move(rows));

    const double w = meanOver(trains_, &TrainFigures::width_s);
    Rows width;
    addWidth(width, w);
    // Where the samples fall moves a width as well, and is in it already: what the trains differ by beyond that counts.
    constexpr double kBeyond = 2;
    const double sampling = dt_ / std::sqrt(6.0);
    if (statisticsOf(columnOf(trains_, &TrainFigures::width_s)).sd > kBeyond * sampling) {
        addSpread(width, trains_, &TrainFigures::width_s);
    }
    out.width_s = figure(w, std::move(width));

    const double peak = largestOf(trains_, &TrainFigures::peak_v);
    Rows top;
    v_.addGain(top, peak);
    v_.addLevel(top, 1);
    addNormal(top, "noise of voltage", trains_.front().noise_v);
    addNormal(top, "between two samples", largestOf(trains_, &TrainFigures::step_v) / kSqrt12);
    out.peak_v = figure(peak, std::move(top));
}

/// The shortest from onset to onset in one record. NaN where it does not hold two trains.
double shortestIn(const Capture& rhythm, const ExpectedTrain& expected) {
    MeasureOptions options;
    if (expected.pulses > 1) options.intraTrainRate = Hertz(expected.rate_hz);
    const auto measured = measureTrains({&rhythm, 1}, drivenBy(expected), options);
    return measured && measured->interval_s.n > 0 ? measured->interval_s.min : kNaN;
}

void Evaluation::addInterval(LoadReading& out, const Capture* rhythm) const {
    double shortest = std::numeric_limits<double>::infinity();
    Rows rows;
    if (rhythm != nullptr) {
        shortest = shortestIn(*rhythm, expected_);
        if (std::isnan(shortest)) {
            out.warnings.emplace_back("the record for the interval does not hold two trains");
            return;
        }
        addNormal(rows, "sampling of the onsets", 1 / rhythm->rate_hz / std::sqrt(6.0));
        rows.push_back({"time base", Distribution::Rectangular, rhythm->timeBaseTolerance, kSqrt3, shortest});
    } else {
        for (std::size_t k = 1; k < trains_.size(); ++k) {
            shortest = std::min(shortest, trains_[k].onset_s - trains_[k - 1].onset_s);
        }
        addNormal(rows, "sampling of the onsets", dt_ / std::sqrt(6.0));
        addTimeBase(rows, shortest);
        rows.push_back({"time stamps", Distribution::Rectangular, stamp_s_, kSqrt3 / kSqrt2, 1});
    }
    if (!std::isfinite(shortest) || !(shortest > 0)) return;
    out.interval_s = figure(shortest, std::move(rows));
}

/// Trains that the worst window of `seconds` holds at `interval_s`, which may be long by `slack_s`; NaN without one.
double trainsIn(double seconds, double interval_s, double slack_s) {
    if (std::isnan(interval_s)) return kNaN;
    const double trains = seconds / interval_s;
    return std::max(1.0, std::ceil(trains - std::max(kWindowEdge, trains * slack_s / interval_s)));
}

/// A whole number of trains, the most that `seconds` can hold at this interval. Where the interval's U leaves open
/// whether there is one more, that one is in the window's own; without that U nothing is known.
Reading windowOf(double seconds, const Reading& perTrain, const Reading& interval_s) {
    const double T = interval_s.value, slack_s = interval_s.measured() ? interval_s.expanded : 0;
    const double trains = trainsIn(seconds, T, slack_s);
    auto out = times(trains, perTrain);
    const double more = (trainsIn(seconds, T - slack_s, 0) - trains) * perTrain.value;
    out.u = interval_s.measured() ? std::hypot(out.u, more / kSqrt3) : kNaN;
    out.expanded = interval_s.measured() ? std::hypot(out.expanded, more) : kNaN;
    return out;
}

void Evaluation::addVoltageWindows(LoadReading& out) const {
    const double squares = largestOf(trains_, &TrainFigures::squares_v);
    Rows rows;
    v_.addGain(rows, 2 * squares);
    v_.addLevel(rows, 2 * largestOf(trains_, &TrainFigures::magnitude_v));
    addWidth(rows, squares);
    out.rms_5s_v = rootOf(windowOf(5, figure(squares, std::move(rows)), out.interval_s), 5, 1);
}

void Evaluation::addCurrent(LoadReading& out) const {
    const double amps = meanOver(trains_, &TrainFigures::end_a);
    const double noise = trains_.front().noise_a;
    Rows end;
    i_.addGain(end, amps);
    i_.addLevel(end, 1);
    addAmplitude(out, out.amplitude_ma, &TrainFigures::end_a, end, expected_.drive == Drive::Current);
    out.amplitude_ma = times(1e3, out.amplitude_ma);
    out.impedance_ohm = impedanceOf(trains_, v_, i_, out.currentLsb);

    const double peak = largestOf(trains_, &TrainFigures::peak_a);
    Rows top;
    i_.addGain(top, peak);
    i_.addLevel(top, 1);
    addNormal(top, "noise of current", noise);
    addNormal(top, "between two samples", largestOf(trains_, &TrainFigures::step_a) / kSqrt12);
    out.peak_ma = times(1e3, figure(peak, std::move(top)));

    const double w = out.width_s.value, pulses = expected_.pulses;
    const double phase = largestOf(trains_, &TrainFigures::phase_C);
    Rows charge;
    i_.addGain(charge, phase);
    i_.addLevel(charge, w);
    addWidth(charge, phase);
    out.charge_uc = times(1e6, figure(phase, std::move(charge)));

    // Gain is common to both phases and leaves their balance alone; what the converter's steps hide in two plateaus
    // and in the baseline under them does not.
    const double net = largestOf(trains_, &TrainFigures::net_C);
    Rows balance;
    i_.addLevel(balance, w * kSqrt3);
    addNormal(balance, "noise of current", noise * std::sqrt(record_s_ * dt_));
    addSpread(balance, trains_, &TrainFigures::net_C);
    out.imbalance = times(1 / phase, figure(net, balance));
    i_.addGain(balance, net);
    out.net_charge_uc = times(1e6, figure(net, std::move(balance)));

    // The gains of one instrument add up in a product: they may be off together.
    const double energy = largestOf(trains_, &TrainFigures::energy_J);
    Rows work;
    work.push_back({"gains of voltage and current", Distribution::Rectangular, v_.gain() + i_.gain(), kSqrt3, energy});
    v_.addProbe(work, energy);
    i_.addProbe(work, energy);
    addWidth(work, energy);
    v_.addLevel(work, largestOf(trains_, &TrainFigures::magnitude_a) / pulses);
    i_.addLevel(work, largestOf(trains_, &TrainFigures::magnitude_v) / pulses);
    out.energy_mj = times(1e3, figure(energy, std::move(work)));

    const double squares = largestOf(trains_, &TrainFigures::squares_a);
    Rows heat;
    i_.addGain(heat, 2 * squares);
    i_.addLevel(heat, 2 * largestOf(trains_, &TrainFigures::magnitude_a));
    addWidth(heat, squares);
    const Reading train = figure(squares, std::move(heat));
    out.rms_train_ma = rootOf(train, pulses / expected_.rate_hz, 1e3);
    out.rms_1s_ma = rootOf(windowOf(1, train, out.interval_s), 1, 1e3);
    out.rms_5s_ma = rootOf(windowOf(5, train, out.interval_s), 5, 1e3);
    out.dc_ma = times(pulses / 5 * 1e-3, windowOf(5, out.net_charge_uc, out.interval_s));
    out.power_1s_w = times(pulses * 1e-3, windowOf(1, out.energy_mj, out.interval_s));
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

void addFine(LoadReading& out, const Evaluation& evaluation, std::span<const Capture> captures,
             std::span<const Capture> fine, const ExpectedTrain& expected) {
    out.impedance_ohm = out.net_charge_uc = out.imbalance = {};
    Trains ends;
    double net = 0;
    Rows rows;  // of the train with the most net charge
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
        const double here = std::abs(charge.integral) / expected.pulses;
        if (!rows.empty() && !(here > net)) continue;
        net = here;
        rows.clear();
        // A moving level takes every step of the converter alike; what stays is that of the baseline under it.
        rows.push_back({"resolution of current", Distribution::Rectangular,
                        two->wide.channel->lsb > 0 ? two->wide.channel->lsb : kNaN, kSqrt12,
                        charge.wide_s / expected.pulses});
        ChannelDoubt(two->fine.channel).addLevel(rows, out.width_s.value * kSqrt3);
        rows.push_back({"seams of the two ranges", Distribution::Rectangular, two->fine.channel->high * two->fine.dt,
                        kSqrt12, std::sqrt(static_cast<double>(charge.seams))});
        addNormal(rows, "noise of current", two->wide.noise * std::sqrt(charge.wide_s * two->wide.dt));
    }
    const auto* current = channelOf(fine.front(), "current");
    out.impedance_ohm = evaluation.impedanceOf(ends, ChannelDoubt(channelOf(fine.front(), "voltage")),
                                               ChannelDoubt(current), current->lsb);
    const double phase = 1e-6 * out.charge_uc.value;
    out.imbalance = times(1 / phase, evaluation.figure(net, rows));
    ChannelDoubt(current).addGain(rows, net);
    out.net_charge_uc = times(1e6, evaluation.figure(net, std::move(rows)));
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

bool Reading::measured() const noexcept { return std::isfinite(value) && std::isfinite(expanded); }

Reading readingOf(double value, std::vector<Contribution> rows, const BudgetOptions& budget) {
    if (!std::isfinite(value)) return {value, kNaN, kNaN};
    const auto combined = combine(std::move(rows), budget);
    if (!combined) return {value, kNaN, kNaN};
    return {value, combined->combined, combined->expanded};
}

Result<LoadReading> readLoad(std::span<const Capture> captures, const ExpectedTrain& expected,
                             std::span<const Capture> fine, const Capture* rhythm) {
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

    out.notStated = notStatedText(captures.front());
    const bool stamped = std::isfinite(captures.front().stampTolerance_s);
    if (out.notStated.empty() && !stamped && rhythm == nullptr) {
        out.notStated = "the oscilloscope does not state how good the time stamps of its records are";
    }
    const auto* current = channelOf(captures.front(), "current");
    out.biphasic = std::all_of(trains.begin(), trains.end(), [](const auto& train) { return train.biphasic; });
    out.currentLsb = current != nullptr ? current->lsb : 0;
    const Evaluation evaluation(trains, expected, captures.front());
    evaluation.addVoltage(out);
    evaluation.addInterval(out, stamped ? nullptr : rhythm);
    evaluation.addVoltageWindows(out);

    const double peak = largestOf(trains, &TrainFigures::peak_a);
    if (!std::isfinite(peak)) return out;
    if (!(out.currentLsb > 0) || !(peak >= kFewestLsb * out.currentLsb)) {
        out.underTenLsb = true;
        out.warnings.push_back(fmt::format("the current of {:.3g} mA is below 10 LSB of {:.3g} mA: not evaluated",
                                           1e3 * peak, 1e3 * out.currentLsb));
        return out;
    }
    evaluation.addCurrent(out);
    if (!fine.empty()) addFine(out, evaluation, captures, fine, expected);
    return out;
}

}  // namespace tacto
