#include "core/safety/TrainExposure.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "core/base/Statistics.h"
#include "core/safety/DeliveryBounds.h"
#include "core/safety/ExposureRun.h"
#include "core/safety/GateRules.h"
#include "core/safety/SourceTraits.h"

namespace tacto {

namespace {

using exposure::larger;
using exposure::largerRun;
using exposure::Plan;
using exposure::Run;
using exposure::storedAt;
using exposure::worstRun;

/// Returns how many whole periods any window can touch; the 1e-9 keeps 5 s / 0.5 s at 10.
double periodsIn(double window_s, double period_s) noexcept { return std::ceil(window_s / period_s - 1e-9); }

/// Returns the largest share of a pulse's power into a resistor within a stretch of time: the larger phase first,
/// then the other phase, as if there were no gap.
double shareOfPulse(const PulseSegments& pulse, double seconds) noexcept {
    const DriveSegment *more = &pulse.items[0], *less = &pulse.items[pulse.count - 1];
    if (std::abs(less->start) > std::abs(more->start)) std::swap(more, less);
    const double first = more->start * more->start, second = pulse.count > 1 ? less->start * less->start : 0;
    const double all = first * more->duration_s + second * less->duration_s;
    if (!(all > 0)) return 1;
    const double after = std::clamp(seconds - more->duration_s, 0.0, less->duration_s);
    return (first * std::min(seconds, more->duration_s) + second * after) / all;
}

/// The most that any stretch of a train holds, in pulses: `power` for sums of squares, `charge` for leftover charge.
/// A pulse that the stretch cuts is included whole; into a resistor, only the part that may lie inside.
struct PulsesIn {
    double power = 0, charge = 0;
    PulsesIn(const PulseSegments& pulse, double seconds, double period, bool resistor) noexcept
        : power(periodsIn(seconds, period)), charge(power) {
        if (!resistor) return;
        const double periods = std::floor(seconds / period);
        power = periods + shareOfPulse(pulse, std::max(0.0, seconds - periods * period));
    }
};

/// Returns the sums over any `intervals` intervals.
TrainSums trainsOf(const Run& run, double intervals) noexcept {
    return {intervals * run.whole.currentSquared_A2s + run.cutTrain.squares,
            intervals * run.whole.voltageSquared_V2s + run.cutTrain.volts, intervals * run.whole.netCharge_C,
            intervals * run.whole.dissipated_J + run.cutTrain.dissipated, run.whole.stored_J};
}

/// Returns the sums over `count` pulses within a train.
TrainSums pulsesOf(const Run& run, const PulsesIn& count) noexcept {
    return {count.power * run.pulse.squares + run.cut.squares, count.power * run.pulse.volts + run.cut.volts,
            count.charge * run.netCharge, count.power * run.pulse.dissipated + run.cut.dissipated, run.whole.stored_J};
}

/// Returns the same for pulses of several trains, which may find the load in different states.
TrainSums pulsesOfTrains(const Run& run, const PulsesIn& count) noexcept {
    TrainSums sums = pulsesOf(run, count);
    sums += {run.cutTrain.squares, run.cutTrain.volts, 0, run.cutTrain.dissipated, 0};
    return sums;
}

TrainSums smallerSums(const TrainSums& a, const TrainSums& b) noexcept {
    // a < b is false if either is NaN; then NaN must not be hidden by the other value.
    const auto smaller = [](double x, double y) { return std::isnan(x) || x < y ? x : y; };
    return {smaller(a.currentSquared_A2s, b.currentSquared_A2s), smaller(a.voltageSquared_V2s, b.voltageSquared_V2s),
            smaller(a.netCharge_C, b.netCharge_C), smaller(a.dissipated_J, b.dissipated_J),
            smaller(a.stored_J, b.stored_J)};
}

/// Returns the load for limits, without drift and lost contact, which could make it seem harmless at one moment.
Load steadyLoad(Load load) noexcept {
    load.driftPerSecond = 0;
    load.openFraction = 0;
    load.windowCount = 0;
    return load;
}

/// Returns the run of a current source that stops at its compliance. Currents stay as without it (larger), unless
/// clipping does harm: unequally clipped phases are unbalanced, and the charge that they leave flows later.
Run clipped(Plan plan, const Run& unlimited, double compliance, const PulseTrain& train, Carried carried) noexcept {
    Run run = unlimited;
    if (plan.circuit.hasCapacitor()) {
        plan.limits.compliance_V = compliance;
        run = largerRun(run, worstRun(plan, carried.voltage_V));
        run.endOfTrain = larger(compliance, run.endOfTrain);
    }
    run.peakVoltage = compliance;
    const DriveSegment& leading = plan.pulse.items[0];
    const DriveSegment& last = plan.pulse.items[plan.pulse.count - 1];
    double moved = leading.duration_s * std::abs(leading.start);  // charge, C
    if (plan.pulse.count > 1) moved += last.duration_s * std::abs(last.start);
    run.energy = std::min(run.energy, compliance * moved);
    // The capacitor holds at most the compliance, or the voltage that it held before.
    const double stored =
        std::min(run.whole.stored_J, larger(storedAt(plan, compliance), storedAt(plan, carried.voltage_V)));
    run.whole.stored_J = stored;
    run.pulse.dissipated = std::min(run.pulse.dissipated, compliance * moved + stored);
    run.whole.dissipated_J = std::min(run.whole.dissipated_J, compliance * moved * train.pulses + stored);
    if (plan.circuit.hasCapacitor() || train.shape != PulseShape::SymmetricBiphasic) {
        run.netCharge = larger(run.phaseCharge, run.netCharge);
        run.whole.netCharge_C = larger(run.phaseCharge * train.pulses, run.whole.netCharge_C);
    }
    return run;
}

TrainExposure unknownExposure() noexcept {
    TrainExposure unknown;
    unknown.values.fill(kNaN);
    unknown.in1s = unknown.in5s = {kNaN, kNaN, kNaN, kNaN, kNaN};
    unknown.residual_V = kNaN;
    return unknown;
}
}  // namespace

TrainSums& TrainSums::operator+=(const TrainSums& other) noexcept {
    currentSquared_A2s += other.currentSquared_A2s;
    voltageSquared_V2s += other.voltageSquared_V2s;
    netCharge_C += other.netCharge_C;
    dissipated_J += other.dissipated_J;
    stored_J = larger(stored_J, other.stored_J);
    return *this;
}

double windowedValue(Quantity quantity, const TrainSums& inWindow, double area_cm2) noexcept {
    const double rms_mA = std::sqrt(inWindow.currentSquared_A2s / 5) * 1e3;
    switch (quantity) {
        case Quantity::RmsCurrent1s:
            return std::sqrt(inWindow.currentSquared_A2s) * 1e3;
        case Quantity::RmsCurrent5s:
            return rms_mA;
        case Quantity::RmsVoltage5s:
            return std::sqrt(inWindow.voltageSquared_V2s / 5);
        case Quantity::DcCurrent:
            return inWindow.netCharge_C / 5 * 1e3;
        case Quantity::CurrentDensity:
            return rms_mA / area_cm2;
        case Quantity::PowerDensity:
            return (inWindow.dissipated_J + inWindow.stored_J) / area_cm2;
        default:
            return kNaN;
    }
}

TrainExposure exposureOf(const PulseTrain& train, Seconds interval, const Load& load, const SourceTraits& source,
                         double area_cm2, Carried carried) noexcept {
    return exposureOf(TrainRange{train, train}, interval, load, source, area_cm2, carried);
}

TrainExposure exposureOf(const TrainRange& trains, Seconds interval, const Load& load, const SourceTraits& source,
                         double area_cm2, Carried carried) noexcept {
    const PulseTrain& train = trains.densest;
    const double duration = train.duration().count(), mostDuration = trains.sparsest.duration().count();
    const double T = interval.count();
    const bool valid = validate(train) && validate(trains.sparsest) && std::isfinite(T);
    if (!valid || !(std::max(duration, mostDuration) <= T * (1 + 1e-9))) return unknownExposure();

    const bool current = isCurrent(train.amplitude);
    Plan plan;
    plan.pulse = segmentsOf(train, source.gap);
    plan.circuit = circuitAt(steadyLoad(load), 0, plan.pulse.span());
    plan.betweenPulses = restOf(source.gap, restBetweenPulses(train));
    plan.leastPulse_s = exposure::leastDurations(plan.pulse, segmentsOf(trains.sparsest, source.gap));
    plan.mostBetweenPulses_s = restBetweenPulses(trains.sparsest).count();
    plan.afterTrain = restOf(source.gap, Seconds(std::max(T - duration, 0.0)));
    plan.leastAfterTrain_s = std::max(T - mostDuration, 0.0);
    plan.pulses = train.pulses;
    const double period = 1 / train.rate.value();
    Run run = worstRun(plan, carried.voltage_V);

    const double compliance = source.compliance.value();
    const bool clips = current && compliance > 0 && run.peakVoltage > compliance;
    if (clips) run = clipped(plan, run, compliance, train, carried);

    const auto pulsesIn = [&, resistor = !plan.circuit.hasCapacitor() && !clips](double seconds) {
        return PulsesIn(plan.pulse, seconds, period, resistor);
    };
    // Each whole interval that fits into the window holds one train, wherever it begins. The rest holds at most one
    // train, and at most the pulses of a stretch of that length: pulses of two trains are farther apart.
    const auto inWindow = [&](double window_s) {
        const double wholeTrains = std::floor(window_s / T);
        TrainSums sums =
            smallerSums(trainsOf(run, 1), pulsesOfTrains(run, pulsesIn(std::max(0.0, window_s - wholeTrains * T))));
        if (wholeTrains > 0) sums += trainsOf(run, wholeTrains);
        return smallerSums(sums,
                           smallerSums(trainsOf(run, periodsIn(window_s, T)), pulsesOfTrains(run, pulsesIn(window_s))));
    };
    TrainExposure exposure;
    // A train longer than the window does not fit into it as a whole.
    exposure.in1s = smallerSums(run.whole, pulsesOf(run, pulsesIn(1)));
    exposure.in5s = smallerSums(run.whole, pulsesOf(run, pulsesIn(5)));
    exposure.residual_V = std::abs(run.endOfTrain);
    const TrainSums second = inWindow(1), five = inWindow(5);

    const auto set = [&exposure](Quantity q, double value) { exposure.values[indexOf(q)] = value; };
    set(Quantity::CommandVoltage, commandVoltage(train, load, source));
    set(Quantity::PeakVoltage, run.peakVoltage);
    set(Quantity::PeakCurrent, run.peakCurrent * 1e3);
    set(Quantity::PhaseCharge, run.phaseCharge * 1e6);
    set(Quantity::NetCharge, run.netCharge * 1e6);
    set(Quantity::PulseEnergy, run.energy * 1e3);
    set(Quantity::RmsCurrentTrain, std::sqrt(run.inDuration.currentSquared_A2s / duration) * 1e3);
    for (const Quantity q : {Quantity::RmsCurrent1s, Quantity::PowerDensity})
        set(q, windowedValue(q, second, area_cm2));
    for (const Quantity q :
         {Quantity::RmsCurrent5s, Quantity::RmsVoltage5s, Quantity::DcCurrent, Quantity::CurrentDensity}) {
        set(q, windowedValue(q, five, area_cm2));
    }
    return exposure;
}

double commandVoltage(const PulseTrain& train, const Load& load, const SourceTraits& source) noexcept {
    const double amplitude = siValue(train.amplitude);
    if (!isCurrent(train.amplitude) || amplitude == 0) return amplitude;
    return amplitude * effectiveImpedance(steadyLoad(load), segmentsOf(train, source.gap).items[0]).value();
}

Ohms impedanceOf(const Load& load, const PulseTrain& train, const SourceTraits& source) noexcept {
    return effectiveImpedance(load, segmentsOf(trainAt(train, source.drive, 1), source.gap).items[0]);
}

TrainExposure worse(const TrainExposure& a, const TrainExposure& b) noexcept {
    TrainExposure both;
    for (std::size_t i = 0; i < kQuantityCount; ++i) both.values[i] = larger(a.values[i], b.values[i]);
    both.in1s = exposure::largerSums(a.in1s, b.in1s);
    both.in5s = exposure::largerSums(a.in5s, b.in5s);
    both.residual_V = larger(a.residual_V, b.residual_V);
    return both;
}

TrainExposure worstExposure(const PulseTrain& train, Seconds interval, const LoadRange& load,
                            const SourceTraits& source, double area_cm2, Carried carried) noexcept {
    return worstExposure(TrainRange{train, train}, interval, load, source, area_cm2, carried);
}

TrainExposure worstExposure(const TrainRange& trains, Seconds interval, const LoadRange& load,
                            const SourceTraits& source, double area_cm2, Carried carried) noexcept {
    TrainExposure worst = worse(exposureOf(trains, interval, load.min, source, area_cm2, carried),
                                exposureOf(trains, interval, load.max, source, area_cm2, carried));
    double& command = worst.values[indexOf(Quantity::CommandVoltage)];
    // Keep NaN for a train that is not valid.
    if (!std::isnan(command)) command = commandVoltage(trains.densest, load.nominal, source);
    return worst;
}

namespace gate {
ExposureRow rowOf(const ActiveLimit& limit, double value, bool areaKnown, bool commandComputed) noexcept {
    const LimitRow& wanted = limit.row;
    ExposureRow row;
    row.quantity = wanted.quantity;
    row.value = value;
    row.limit = wanted.max;
    row.unit = unitOf(wanted.quantity);
    row.window_s = windowOf(wanted.quantity);
    row.set = limit.set;
    row.action = wanted.action;
    row.judged = wanted.judged;
    row.strict = wanted.strict;
    row.evaluated = areaKnown || !needsArea(wanted.quantity);
    row.within = row.evaluated && keepsLimit(wanted, value, commandComputed);
    if (!row.evaluated) row.reason = "the electrode area is not given";
    return row;
}

ExposureRow shownRow(Quantity quantity, double value) noexcept {
    ExposureRow row;
    row.quantity = quantity;
    row.value = value;
    row.limit = std::numeric_limits<double>::quiet_NaN();
    row.unit = unitOf(quantity);
    row.window_s = windowOf(quantity);
    row.action = LimitAction::Disclose;
    row.evaluated = true;
    row.within = true;
    return row;
}
bool hasRow(std::span<const ExposureRow> rows, Quantity quantity) noexcept {
    return std::any_of(rows.begin(), rows.end(), [quantity](const auto& row) { return row.quantity == quantity; });
}
}  // namespace gate

std::vector<ExposureRow> exposureTable(const GateSetup& setup, const PulseTrain& train, Seconds interval) {
    const double area = gate::areaOf(setup);
    const DeliveryBounds bounds(setup);
    const auto [shortest, longest] = bounds.intervals(interval);
    TrainExposure overRange = bounds.worst(train, setup.load, [&, least = shortest](const auto& out) {
        return worstExposure(out, least, setup.load, setup.source, area);
    });
    TrainExposure at500 = exposureOf(bounds.densest(train), shortest, Load::resistor(Ohms(500)), setup.source, area);
    // Judge the command as it is; keep NaN if the train cannot be judged.
    for (TrainExposure* exposure : {&overRange, &at500}) {
        double& command = exposure->values[indexOf(Quantity::CommandVoltage)];
        if (!std::isnan(command)) command = commandVoltage(bounds.commandOf(train), setup.load.nominal, setup.source);
    }
    std::vector<ExposureRow> rows;
    for (const auto& limit : gate::activeLimits(setup)) {
        if (!limit.row.holdsAt(1 / longest.count()) && !limit.row.holdsAt(1 / shortest.count())) continue;
        const TrainExposure& judged = limit.row.judged == JudgedAt::Ohm500 ? at500 : overRange;
        rows.push_back(gate::rowOf(limit, judged.at(limit.row.quantity), setup.electrodeArea.has_value(),
                                   isCurrent(train.amplitude) || setup.calibration));
    }
    for (const auto quantity : gate::kShown) {
        if (!gate::hasRow(rows, quantity)) rows.push_back(gate::shownRow(quantity, overRange.at(quantity)));
    }
    return rows;
}

bool forbids(const ExposureRow& row) noexcept {
    return row.action == LimitAction::Refuse && row.evaluated && !row.within;
}

const ExposureRow* firstForbidding(std::span<const ExposureRow> rows) noexcept {
    const auto found = std::ranges::find_if(rows, forbids);
    return found == rows.end() ? nullptr : &*found;
}

std::string forbiddenBy(const GateSetup& setup, const PulseTrain& train, Seconds interval) {
    const auto rows = exposureTable(setup, train, interval);
    const auto* row = firstForbidding(rows);
    return row == nullptr ? std::string() : fmt::format("{} ({})", titleOf(row->quantity), row->set.view());
}

}  // namespace tacto
