#include "core/safety/TrainExposure.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "core/base/NaN.h"
#include "core/electrode/LoadResponse.h"

namespace tacto {

namespace {

/// The larger of both; NaN wins, so that it is refused and not lost.
double larger(double a, double b) noexcept { return std::isnan(a) || a > b ? a : b; }

/// What one run of a train adds up to, starting with some voltage on the load's capacitor.
struct Run {
    double peakVoltage = 0, peakCurrent = 0, phaseCharge = 0;  // Largest of any pulse
    double netCharge = 0, energy = 0, squares = 0, volts = 0;  // Largest of any pulse, its rest included
    double dissipated = 0;                                     // The same: energy less what the capacitor kept, J
    TrainSums inDuration;                                      // Over n / rate
    TrainSums whole;                                           // The same with the rest until the next train
    double endOfTrain = 0;                                     // Capacitor voltage after n / rate, V
    double endOfInterval = 0;                                  // and when the next train begins
};

/// Everything about a run but its start: constant while one exposure is computed.
struct Plan {
    Circuit circuit;
    PulseSegments pulse;
    DriveSegment betweenPulses;
    DriveSegment afterTrain;
    int pulses = 1;
    SourceLimits limits;  // Infinite: what clipping takes away is counted as delivered
};

double voltageSquared(const SegmentResponse& response) noexcept {
    double sum = 0;
    for (ResponsePiece piece : response.pieces()) {
        piece.i = piece.v;  // ∫i² of a piece whose current is its voltage
        sum += piece.currentSquared();
    }
    return sum;
}

PulsePart partOf(const PulseSegments& pulse, std::size_t s) noexcept {
    if (s == 0) return PulsePart::LeadingPhase;
    return s + 1 == pulse.count ? PulsePart::SecondPhase : PulsePart::Gap;
}

double storedAt(const Plan& plan, double capacitorVoltage) noexcept {
    return plan.circuit.hasCapacitor() ? 0.5 * plan.circuit.capacitance_F * capacitorVoltage * capacitorVoltage : 0;
}

Run runFrom(const Plan& plan, double capacitorVoltage) noexcept {
    Run run;
    double stored = storedAt(plan, capacitorVoltage);
    for (int done = 0; done < plan.pulses;) {
        PulseResponse response(plan.circuit, plan.limits, capacitorVoltage);
        double volts = 0;
        const double found = storedAt(plan, capacitorVoltage);
        for (std::size_t s = 0; s < plan.pulse.count; ++s) {
            volts += voltageSquared(response.add(plan.pulse.items[s], partOf(plan.pulse, s)));
            stored = larger(storedAt(plan, response.capacitorVoltage()), stored);
        }
        if (plan.betweenPulses.duration_s > 0)
            volts += voltageSquared(response.add(plan.betweenPulses, PulsePart::Rest));
        const PulseTotals& totals = response.totals();
        const double dissipated = totals.energy_J + found - storedAt(plan, response.capacitorVoltage());

        // Once a pulse leaves the capacitor as it found it, all further pulses are this one.
        const double moved = std::abs(response.capacitorVoltage() - capacitorVoltage);
        const bool settled = moved <= 1e-12 * totals.peakVoltage_V;
        const int alike = settled ? plan.pulses - done : 1;
        done += alike;

        run.peakVoltage = larger(totals.peakVoltage_V, run.peakVoltage);
        run.peakCurrent = larger(totals.peakCurrent_A, run.peakCurrent);
        run.phaseCharge = larger(totals.phaseCharge_C(), run.phaseCharge);
        run.netCharge = larger(std::abs(totals.netCharge_C), run.netCharge);
        run.energy = larger(totals.energy_J, run.energy);
        run.dissipated = larger(dissipated, run.dissipated);
        run.squares = larger(totals.currentSquared_A2s, run.squares);
        run.volts = larger(volts, run.volts);
        run.inDuration.netCharge_C += alike * std::abs(totals.netCharge_C);
        run.inDuration.currentSquared_A2s += alike * totals.currentSquared_A2s;
        run.inDuration.voltageSquared_V2s += alike * volts;
        run.inDuration.dissipated_J += alike * dissipated;
        run.inDuration.stored_J = stored;
        capacitorVoltage = response.capacitorVoltage();

        if (done >= plan.pulses) {
            run.endOfTrain = capacitorVoltage;
            run.whole = run.inDuration;
            if (plan.afterTrain.duration_s > 0) {
                PulseResponse tail(plan.circuit, plan.limits, capacitorVoltage);
                const double tailVolts = voltageSquared(tail.add(plan.afterTrain, PulsePart::Rest));
                const PulseTotals& after = tail.totals();
                run.whole.currentSquared_A2s += after.currentSquared_A2s;
                run.whole.voltageSquared_V2s += tailVolts;
                const double kept = storedAt(plan, capacitorVoltage) - storedAt(plan, tail.capacitorVoltage());
                run.whole.dissipated_J += after.energy_J + kept;
                run.dissipated = larger(dissipated + after.energy_J + kept, run.dissipated);
                run.peakCurrent = larger(after.peakCurrent_A, run.peakCurrent);
                // The last pulse's tail is longer than the others', unless the next train comes early: the larger.
                const double before = std::abs(totals.netCharge_C);
                const double last = std::abs(totals.netCharge_C + after.netCharge_C);
                run.netCharge = larger(last, run.netCharge);
                run.whole.netCharge_C += larger(last, before) - before;
                run.energy = larger(totals.energy_J + after.energy_J, run.energy);
                run.squares = larger(totals.currentSquared_A2s + after.currentSquared_A2s, run.squares);
                run.volts = larger(volts + tailVolts, run.volts);
                capacitorVoltage = tail.capacitorVoltage();
            }
            run.endOfInterval = capacitorVoltage;
        }
    }
    return run;
}

TrainSums largerSums(const TrainSums& a, const TrainSums& b) noexcept {
    return {larger(a.currentSquared_A2s, b.currentSquared_A2s), larger(a.voltageSquared_V2s, b.voltageSquared_V2s),
            larger(a.netCharge_C, b.netCharge_C), larger(a.dissipated_J, b.dissipated_J),
            larger(a.stored_J, b.stored_J)};
}

Run largerRun(const Run& a, const Run& b) noexcept {
    Run r;
    r.peakVoltage = larger(a.peakVoltage, b.peakVoltage);
    r.peakCurrent = larger(a.peakCurrent, b.peakCurrent);
    r.phaseCharge = larger(a.phaseCharge, b.phaseCharge);
    r.netCharge = larger(a.netCharge, b.netCharge);
    r.energy = larger(a.energy, b.energy);
    r.dissipated = larger(a.dissipated, b.dissipated);
    r.squares = larger(a.squares, b.squares);
    r.volts = larger(a.volts, b.volts);
    r.inDuration = largerSums(a.inDuration, b.inDuration);
    r.whole = largerSums(a.whole, b.whole);
    r.endOfTrain = larger(std::abs(a.endOfTrain), std::abs(b.endOfTrain));
    r.endOfInterval = larger(std::abs(a.endOfInterval), std::abs(b.endOfInterval));
    return r;
}

/// Worst over every state in which a train can find the load. A linear load's state moves toward its steady one
/// monotonically, and all figures are convex in it, so the ends of the range hold the worst.
Run worstRun(const Plan& plan, double carried) noexcept {
    const Run rested = runFrom(plan, 0);
    Run worst = rested;
    if (!plan.circuit.hasCapacitor()) return worst;
    const double small = 1e-12 * rested.peakVoltage;
    if (!(std::abs(rested.endOfInterval) <= small)) {
        // The state maps linearly from train to train: x' = f(0) + slope·x.
        const double probe = rested.peakVoltage;
        const double slope = (runFrom(plan, probe).endOfInterval - rested.endOfInterval) / probe;
        // Below 1 whenever charge can leak; a load that only collects has no steady state and is refused as NaN.
        const double steady = slope < 1 ? rested.endOfInterval / (1 - slope) : kNaN;
        worst = largerRun(worst, runFrom(plan, steady));
    }
    if (!(carried <= small)) {
        worst = largerRun(worst, largerRun(runFrom(plan, carried), runFrom(plan, -carried)));
    }
    return worst;
}

/// How many whole periods any window touches at most; a billionth keeps 5 s / 0.5 s at 10.
double periodsIn(double window_s, double period_s) noexcept { return std::ceil(window_s / period_s - 1e-9); }

TrainSums times(double factor, const TrainSums& sums) noexcept {
    return {factor * sums.currentSquared_A2s, factor * sums.voltageSquared_V2s, factor * sums.netCharge_C,
            factor * sums.dissipated_J, sums.stored_J};
}

TrainSums smallerSums(const TrainSums& a, const TrainSums& b) noexcept {
    // a < b is false for NaN in either, and then the other must not hide it.
    const auto smaller = [](double x, double y) { return std::isnan(x) || x < y ? x : y; };
    return {smaller(a.currentSquared_A2s, b.currentSquared_A2s), smaller(a.voltageSquared_V2s, b.voltageSquared_V2s),
            smaller(a.netCharge_C, b.netCharge_C), smaller(a.dissipated_J, b.dissipated_J),
            smaller(a.stored_J, b.stored_J)};
}

/// A load as limits see it: drift and lost contact would make it seem harmless at one moment.
Load steadyLoad(Load load) noexcept {
    load.driftPerSecond = 0;
    load.openFraction = 0;
    load.windowCount = 0;
    return load;
}

/// A current source stops at its compliance. Currents stay as if it did not, which is the larger, except where
/// clipping itself does harm: phases that clip differently no longer balance, and what they leave behind flows later.
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
    double moved = leading.duration_s * std::abs(leading.start);  // Charge, C
    if (plan.pulse.count > 1) moved += last.duration_s * std::abs(last.start);
    run.energy = std::min(run.energy, compliance * moved);
    // The capacitor holds no more than the compliance, or than it held before.
    const double stored =
        std::min(run.whole.stored_J, larger(storedAt(plan, compliance), storedAt(plan, carried.voltage_V)));
    run.whole.stored_J = stored;
    run.dissipated = std::min(run.dissipated, compliance * moved + stored);
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
    const double duration = train.duration().count();
    const double T = interval.count();
    if (!validate(train) || !std::isfinite(T) || !(duration <= T * (1 + 1e-9))) return unknownExposure();

    const bool current = isCurrent(train.amplitude);
    Plan plan;
    plan.pulse = segmentsOf(train, source.gap);
    plan.circuit = circuitAt(steadyLoad(load), 0, plan.pulse.span());
    plan.betweenPulses = restOf(source.gap, restBetweenPulses(train));
    plan.afterTrain = restOf(source.gap, Seconds(std::max(T - duration, 0.0)));
    plan.pulses = train.pulses;
    Run run = worstRun(plan, carried.voltage_V);

    const double compliance = source.compliance.value();
    if (current && compliance > 0 && run.peakVoltage > compliance) run = clipped(plan, run, compliance, train, carried);

    TrainExposure exposure;
    // A train longer than a window cannot put all of itself into it.
    const TrainSums pulse{run.squares, run.volts, run.netCharge, run.dissipated, run.whole.stored_J};
    const double rate = train.rate.value();
    exposure.in1s = smallerSums(run.whole, times(periodsIn(1, 1 / rate), pulse));
    exposure.in5s = smallerSums(run.whole, times(periodsIn(5, 1 / rate), pulse));
    exposure.residual_V = std::abs(run.endOfTrain);
    const TrainSums second = smallerSums(times(periodsIn(1, T), run.whole), times(periodsIn(1, 1 / rate), pulse));
    const TrainSums five = smallerSums(times(periodsIn(5, T), run.whole), times(periodsIn(5, 1 / rate), pulse));

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

TrainExposure worse(const TrainExposure& a, const TrainExposure& b) noexcept {
    TrainExposure both;
    for (std::size_t i = 0; i < kQuantityCount; ++i) both.values[i] = larger(a.values[i], b.values[i]);
    both.in1s = largerSums(a.in1s, b.in1s);
    both.in5s = largerSums(a.in5s, b.in5s);
    both.residual_V = larger(a.residual_V, b.residual_V);
    return both;
}

TrainExposure worstExposure(const PulseTrain& train, Seconds interval, const LoadRange& load,
                            const SourceTraits& source, double area_cm2, Carried carried) noexcept {
    TrainExposure worst = worse(exposureOf(train, interval, load.min, source, area_cm2, carried),
                                exposureOf(train, interval, load.max, source, area_cm2, carried));
    double& command = worst.values[indexOf(Quantity::CommandVoltage)];
    if (!std::isnan(command)) command = commandVoltage(train, load.nominal, source);  // An invalid train stays NaN
    return worst;
}

}  // namespace tacto
