#include "core/analysis/load_safety/LoadFigures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tacto {

namespace {

/// An onset may jitter against the window's edge; a hundredth of a train is not a further train.
constexpr double kWindowEdge = 0.01;
/// For a straight line that is continued to the end: the noise of its value over that of the mean, and the share of the
/// way that a bend may be worth.
constexpr double kLineNoise = 2.6, kLineDoubt = 0.2;

Reading rootOf(const Reading& squares, double seconds, double scale) {
    if (std::isnan(squares.value) || std::isnan(seconds)) return {};
    if (!(squares.value > 0)) return {0, 0, 0};
    const double rms = std::sqrt(squares.value / seconds) * scale;
    const double half = rms * 0.5 / squares.value;
    return {rms, half * squares.u, half * squares.expanded};
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

/// The shortest from onset to onset in one record. NaN where it does not hold two trains.
double shortestIn(const Capture& rhythm, const ExpectedTrain& expected) {
    MeasureOptions options;
    if (expected.pulses > 1) options.intraTrainRate = Hertz(expected.rate_hz);
    const auto measured = measureTrains({&rhythm, 1}, drivenBy(expected), options);
    return measured && measured->interval_s.n > 0 ? measured->interval_s.min : kNaN;
}

}  // namespace

Reading times(double factor, const Reading& reading) {
    return {factor * reading.value, std::abs(factor) * reading.u, std::abs(factor) * reading.expanded};
}

Reading LoadFigures::figure(double value, BudgetRows rows) const {
    return readingOf(value, std::move(rows), expected_.budget);
}

void LoadFigures::addTimeBase(BudgetRows& rows, double sensitivity) const {
    rows.push_back({"time base", Distribution::Rectangular, timeBase_, kSqrt3, sensitivity});
}

/// The relative uncertainty of a width: what it adds to charges, energies and squares. They all share the time base.
void LoadFigures::addWidth(BudgetRows& rows, double sensitivity) const {
    addTimeBase(rows, sensitivity);
    addNormal(rows, "sampling of the edges", dt_ / std::sqrt(6.0) / meanOver(trains_, &TrainFigures::width_s),
              sensitivity);
}

/// The uncertainty of the voltage at the end of a phase: noise, and the way there; `samples` were averaged.
void LoadFigures::addEnd(BudgetRows& rows, const LoadTrains& trains, double samples, double sensitivity) const {
    const double line = meanOver(trains, &TrainFigures::line_v);
    addNormal(rows, "noise of voltage", (line > 0 ? kLineNoise : 1) * trains.front().noise_v / std::sqrt(samples),
              sensitivity);
    if (line > 0) {
        rows.push_back({"way to the phase's end", Distribution::Rectangular, kLineDoubt * line, kSqrt3, sensitivity});
    }
}

Reading LoadFigures::impedanceOf(const LoadTrains& trains, const ChannelDoubt& v, const ChannelDoubt& i,
                                 double currentLsb) const {
    const double volts = meanOver(trains, &TrainFigures::end_v), amps = meanOver(trains, &TrainFigures::end_a);
    if (!(currentLsb > 0) || !(amps >= kMinLsb * currentLsb)) return {};
    const double samples = trains.front().endSamples * static_cast<double>(trains.size());
    const double ohms = volts / amps;
    BudgetRows rows;
    if (gainShared_) {  // the shared gain divides out
        v.addProbe(rows, ohms);
        i.addProbe(rows, ohms);
    } else {
        v.addGain(rows, ohms);
        i.addGain(rows, ohms);
    }
    v.addLevel(rows, 1 / amps);
    i.addLevel(rows, ohms / amps);
    addEnd(rows, trains, samples, 1 / amps);
    addNormal(rows, "noise of current", trains.front().noise_a / std::sqrt(samples), ohms / amps);
    addSpread(rows, trains, &TrainFigures::impedance);
    return figure(ohms, std::move(rows));
}

/// The mean of the trains, each uncertain by `rows`: their spread includes that of the programmed values.
void LoadFigures::addAmplitude(LoadReading& out, Reading& amplitude, double TrainFigures::*member,
                               const BudgetRows& rows, bool driven) const {
    const double mean = meanOver(trains_, member);
    BudgetRows all = rows;
    addSpread(all, trains_, member);
    amplitude = figure(mean, std::move(all));
    if (!driven) return;
    const double ratio = meanOver(trains_, &TrainFigures::delivered);
    all = rows;
    for (auto& row : all) row.sensitivity *= ratio / mean;
    addSpread(all, trains_, &TrainFigures::delivered);
    out.delivered = figure(ratio, std::move(all));
}

void LoadFigures::addVoltage(LoadReading& out) const {
    const double v = meanOver(trains_, &TrainFigures::plateau_v);
    BudgetRows rows;
    v_.addGain(rows, v);
    v_.addLevel(rows, 1);
    addEnd(rows, trains_, trains_.front().endSamples, 1);
    addAmplitude(out, out.amplitude_v, &TrainFigures::plateau_v, rows, expected_.drive == Drive::Voltage);
    // The train with the most counts: the difference between trains is not part of its uncertainty.
    const double highest = largestOf(trains_, &TrainFigures::plateau_v);
    for (auto& row : rows) row.sensitivity *= highest / v;
    out.highest_v = figure(highest, std::move(rows));

    const double w = meanOver(trains_, &TrainFigures::width_s);
    BudgetRows width;
    addWidth(width, w);
    // The position of the samples moves a width, too, and is in it already: only larger differences of trains count.
    constexpr double kBeyond = 2;
    const double sampling = dt_ / std::sqrt(6.0);
    if (statisticsOver(trains_, &TrainFigures::width_s).sd > kBeyond * sampling) {
        addSpread(width, trains_, &TrainFigures::width_s);
    }
    out.width_s = figure(w, std::move(width));

    const double peak = largestOf(trains_, &TrainFigures::peak_v);
    BudgetRows top;
    v_.addGain(top, peak);
    v_.addLevel(top, 1);
    addNormal(top, "noise of voltage", trains_.front().noise_v);
    addNormal(top, "between two samples", largestOf(trains_, &TrainFigures::step_v) / kSqrt12);
    out.peak_v = figure(peak, std::move(top));
}

/// The uncertainty of where the first and the last pulse of a train begin, relative to what lies between them.
void LoadFigures::addOnsets(BudgetRows& rows, double rate_hz, double sensitivity) const {
    addNormal(rows, "sampling of the onsets", dt_ / std::sqrt(6.0) * rate_hz / (expected_.pulses - 1), sensitivity);
}

void LoadFigures::addRate(LoadReading& out) const {
    const double fastest = largestOf(trains_, &TrainFigures::rate_hz);
    BudgetRows rows;
    addTimeBase(rows, fastest);
    addOnsets(rows, fastest, fastest);
    out.rate_hz = figure(fastest, std::move(rows));
}

void LoadFigures::addInterval(LoadReading& out, const Capture* rhythm) const {
    double shortest = std::numeric_limits<double>::infinity();
    BudgetRows rows;
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

void LoadFigures::addVoltageWindows(LoadReading& out) const {
    const double squares = largestOf(trains_, &TrainFigures::squares_v);
    BudgetRows rows;
    v_.addGain(rows, 2 * squares);
    v_.addLevel(rows, 2 * largestOf(trains_, &TrainFigures::magnitude_v));
    addWidth(rows, squares);
    out.rms_5s_v = rootOf(windowOf(5, figure(squares, std::move(rows)), out.interval_s), 5, 1);
}

void LoadFigures::addCurrent(LoadReading& out) const {
    const double amps = meanOver(trains_, &TrainFigures::end_a);
    const double noise = trains_.front().noise_a;
    BudgetRows end;
    i_.addGain(end, amps);
    i_.addLevel(end, 1);
    addAmplitude(out, out.amplitude_ma, &TrainFigures::end_a, end, expected_.drive == Drive::Current);
    out.amplitude_ma = times(1e3, out.amplitude_ma);
    out.impedance_ohm = impedanceOf(trains_, v_, i_, out.currentLsb);

    const double peak = largestOf(trains_, &TrainFigures::peak_a);
    BudgetRows top;
    i_.addGain(top, peak);
    i_.addLevel(top, 1);
    addNormal(top, "noise of current", noise);
    addNormal(top, "between two samples", largestOf(trains_, &TrainFigures::step_a) / kSqrt12);
    out.peak_ma = times(1e3, figure(peak, std::move(top)));

    const double w = out.width_s.value, pulses = expected_.pulses;
    const double phase = largestOf(trains_, &TrainFigures::phase_C);
    BudgetRows charge;
    i_.addGain(charge, phase);
    i_.addLevel(charge, w);
    addWidth(charge, phase);
    out.charge_uc = times(1e6, figure(phase, std::move(charge)));

    // Gain is common to both phases and leaves their balance alone; what the converter's steps hide in two plateaus
    // and in the baseline under them does not, nor do four edges, each somewhere within a sample.
    const double net = largestOf(trains_, &TrainFigures::net_C);
    BudgetRows balance;
    i_.addOpposites(balance, w);
    addNormal(balance, "sampling of the edges", phase / w * dt_ / kSqrt3);
    addNormal(balance, "noise of current", noise * std::sqrt(record_s_ * dt_));
    out.imbalance = times(1 / phase, figure(net, balance));
    i_.addGain(balance, net);
    out.net_charge_uc = times(1e6, figure(net, std::move(balance)));

    // The gains of one instrument add up in a product: they may be off together.
    const double energy = largestOf(trains_, &TrainFigures::energy_J);
    BudgetRows work;
    work.push_back({"gains of voltage and current", Distribution::Rectangular, v_.gain() + i_.gain(), kSqrt3, energy});
    v_.addProbe(work, energy);
    i_.addProbe(work, energy);
    addWidth(work, energy);
    v_.addLevel(work, largestOf(trains_, &TrainFigures::magnitude_a) / pulses);
    i_.addLevel(work, largestOf(trains_, &TrainFigures::magnitude_v) / pulses);
    out.energy_mj = times(1e3, figure(energy, std::move(work)));

    const double squares = largestOf(trains_, &TrainFigures::squares_a);
    BudgetRows heat;
    i_.addGain(heat, 2 * squares);
    i_.addLevel(heat, 2 * largestOf(trains_, &TrainFigures::magnitude_a));
    addWidth(heat, squares);
    const Reading train = figure(squares, heat);
    // The window of a train is as long as the device made it. Its time base is in the squares already.
    const double rate_hz = pulses > 1 ? out.rate_hz.value : expected_.rate_hz;
    if (pulses > 1) addOnsets(heat, rate_hz, squares);
    out.rms_train_ma = rootOf(figure(squares, std::move(heat)), pulses / rate_hz, 1e3);
    out.rms_1s_ma = rootOf(windowOf(1, train, out.interval_s), 1, 1e3);
    out.rms_5s_ma = rootOf(windowOf(5, train, out.interval_s), 5, 1e3);
    out.dc_ma = times(pulses / 5 * 1e-3, windowOf(5, out.net_charge_uc, out.interval_s));
    out.power_1s_w = times(pulses * 1e-3, windowOf(1, out.energy_mj, out.interval_s));
}

namespace {

/// A wide and a fine record of the same command, each known by the onset of its first pulse.
struct TwoRanges {
    LoadTrace wide, fine, voltage;  ///< voltage: of the fine record
    double wideOnset_s = 0, fineOnset_s = 0;
    ChannelMeasurement pulses;  ///< the fine record's pulses
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

}  // namespace

void addFineRange(LoadReading& out, const LoadFigures& figures, std::span<const Capture> captures,
                  std::span<const Capture> fine, const ExpectedTrain& expected) {
    out.impedance_ohm = out.net_charge_uc = out.imbalance = {};
    LoadTrains ends;
    double net = 0;
    BudgetRows rows;  // budget of the train with the most net charge
    for (std::size_t k = 0; k < fine.size(); ++k) {
        const auto two = twoRanges(captures[k % captures.size()], fine[k], expected, out.warnings);
        if (!two) return;
        TrainFigures train;
        readEnds(two->voltage, &two->fine, two->pulses, expected.drive, train);
        train.noise_v = two->voltage.noise;
        train.noise_a = two->fine.noise;
        if (!(train.end_a < 0.98 * two->fine.channel->high)) return;  // the range does not fit the end either
        ends.push_back(train);
        const auto charge = joined(*two);
        const double here = std::abs(charge.integral) / expected.pulses;
        if (!rows.empty() && !(here > net)) continue;
        net = here;
        rows.clear();
        // A moving level takes every step of the converter evenly; the step of the baseline under it stays.
        rows.push_back({"resolution of current", Distribution::Rectangular,
                        two->wide.channel->lsb > 0 ? two->wide.channel->lsb : kNaN, kSqrt12,
                        charge.wide_s / expected.pulses});
        ChannelDoubt(two->fine.channel).addOpposites(rows, out.width_s.value);
        rows.push_back({"seams of the two ranges", Distribution::Rectangular, two->fine.channel->high * two->fine.dt,
                        kSqrt12, std::sqrt(static_cast<double>(charge.seams))});
        addNormal(rows, "noise of current", two->wide.noise * std::sqrt(charge.wide_s * two->wide.dt));
    }
    const auto* current = channelOf(fine.front(), "current");
    out.impedance_ohm = figures.impedanceOf(ends, ChannelDoubt(channelOf(fine.front(), "voltage")),
                                            ChannelDoubt(current), current->lsb);
    const double phase = 1e-6 * out.charge_uc.value;
    out.imbalance = times(1 / phase, figures.figure(net, rows));
    ChannelDoubt(current).addGain(rows, net);
    out.net_charge_uc = times(1e6, figures.figure(net, std::move(rows)));
}

}  // namespace tacto
