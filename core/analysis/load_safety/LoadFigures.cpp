#include "core/analysis/load_safety/LoadFigures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tacto {

namespace {

/// An onset may jitter across the window's edge; a hundredth of a train does not add a whole train.
constexpr double kWindowEdge = 0.01;
/// For a straight line extended to the end of the phase: the noise of its end value relative to the noise of a mean,
/// and the share of the extended rise that curvature may make uncertain.
constexpr double kLineNoise = 2.6, kLineDoubt = 0.2;

Reading rootOf(const Reading& squares, double seconds, double scale) {
    if (std::isnan(squares.value) || std::isnan(seconds)) return {};
    if (!(squares.value > 0)) return {0, 0, 0};
    const double rms = std::sqrt(squares.value / seconds) * scale;
    const double half = rms * 0.5 / squares.value;
    return {rms, half * squares.u, half * squares.expanded};
}

/// Trains in the worst window of `seconds`. `interval_s` may be too long by `slack_s`. NaN without an interval.
double trainsIn(double seconds, double interval_s, double slack_s) {
    if (std::isnan(interval_s)) return kNaN;
    const double trains = seconds / interval_s;
    return std::max(1.0, std::ceil(trains - std::max(kWindowEdge, trains * slack_s / interval_s)));
}

/// Returns the sum over the most trains that `seconds` can hold at this interval. If the interval's U leaves one more
/// train possible, that train goes into U of the result; if the interval has no U, the result has none.
Reading windowOf(double seconds, const Reading& perTrain, const Reading& interval_s) {
    const double T = interval_s.value, slack_s = interval_s.measured() ? interval_s.expanded : 0;
    const double trains = trainsIn(seconds, T, slack_s);
    auto out = times(trains, perTrain);
    const double more = (trainsIn(seconds, T - slack_s, 0) - trains) * perTrain.value;
    out.u = interval_s.measured() ? std::hypot(out.u, more / kSqrt3) : kNaN;
    out.expanded = interval_s.measured() ? std::hypot(out.expanded, more) : kNaN;
    return out;
}

/// Shortest time between two train onsets in one record. NaN if the record does not hold two trains.
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

/// Adds the relative uncertainty of a width, which charges, energies and squares share, together with the time base.
void LoadFigures::addWidth(BudgetRows& rows, double sensitivity) const {
    addTimeBase(rows, sensitivity);
    addNormal(rows, "sampling of the edges", dt_ / std::sqrt(6.0) / meanOver(trains_, &TrainFigures::width_s),
              sensitivity);
}

/// Adds the uncertainty of the voltage at the end of a phase: noise, and the extrapolation. `samples` were averaged.
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

/// Adds a mean over trains that are each uncertain by `rows`. The spread includes that of the programmed values.
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
    // The train with the highest value: the spread between trains is not part of its uncertainty.
    const double highest = largestOf(trains_, &TrainFigures::plateau_v);
    for (auto& row : rows) row.sensitivity *= highest / v;
    out.highest_v = figure(highest, std::move(rows));

    const double w = meanOver(trains_, &TrainFigures::width_s);
    BudgetRows width;
    addWidth(width, w);
    // Sampling also moves a width and is already in the budget, so only larger differences between trains are added.
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

/// Adds the uncertainty of the onsets of a train's first and last pulse, relative to the time between them.
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

    // A gain error scales both phases alike and does not change their balance. The converter's steps in the two
    // plateaus and the baseline do change it, and so do four edges, each known only to within a sample.
    const double net = largestOf(trains_, &TrainFigures::net_C);
    BudgetRows balance;
    i_.addOpposites(balance, w);
    addNormal(balance, "sampling of the edges", phase / w * dt_ / kSqrt3);
    addNormal(balance, "noise of current", noise * std::sqrt(record_s_ * dt_));
    out.imbalance = times(1 / phase, figure(net, balance));
    i_.addGain(balance, net);
    out.net_charge_uc = times(1e6, figure(net, std::move(balance)));

    // The gain errors of one instrument add up in a product, because they may have the same sign.
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
    // The measured rate of the device sets the window of a train. The time base is already in the squares.
    const double rate_hz = pulses > 1 ? out.rate_hz.value : expected_.rate_hz;
    if (pulses > 1) addOnsets(heat, rate_hz, squares);
    out.rms_train_ma = rootOf(figure(squares, std::move(heat)), pulses / rate_hz, 1e3);
    out.rms_1s_ma = rootOf(windowOf(1, train, out.interval_s), 1, 1e3);
    out.rms_5s_ma = rootOf(windowOf(5, train, out.interval_s), 5, 1e3);
    out.dc_ma = times(pulses / 5 * 1e-3, windowOf(5, out.net_charge_uc, out.interval_s));
    out.power_1s_w = times(pulses * 1e-3, windowOf(1, out.energy_mj, out.interval_s));
}

namespace {

/// A wide-range and a fine-range record of the same command, aligned by the onset of their first pulses.
struct TwoRanges {
    LoadTrace wide, fine, voltage;  ///< voltage: of the fine record
    double wideOnset_s = 0, fineOnset_s = 0;
    ChannelMeasurement pulses;  ///< pulses measured in the fine record
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

/// Integral of the fine current, with the wide record where the fine one clips; also the length and number of joins.
struct Joined {
    double integral = 0, wide_s = 0;
    std::size_t seams = 0;
};
Joined joined(const TwoRanges& two) {
    constexpr std::size_t kAside = 3;  // samples next to a clipped one: the amplifier is still recovering
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
        if (!(train.end_a < 0.98 * two->fine.channel->high)) return;  // the end of the phase clips in this range, too
        ends.push_back(train);
        const auto charge = joined(*two);
        const double here = std::abs(charge.integral) / expected.pulses;
        if (!rows.empty() && !(here > net)) continue;
        net = here;
        rows.clear();
        // Converter steps average out while the level moves, but the step error of the baseline remains.
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
