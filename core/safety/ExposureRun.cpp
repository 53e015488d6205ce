#include "core/safety/ExposureRun.h"

#include <algorithm>
#include <limits>

#include "core/base/NaN.h"

namespace tacto::exposure {

std::array<double, 3> leastDurations(const PulseSegments& longest, const PulseSegments& shortest) noexcept {
    std::array<double, 3> durations{};
    durations[0] = shortest.items[0].duration_s;
    if (longest.count > 1) durations[longest.count - 1] = shortest.items[shortest.count - 1].duration_s;
    if (shortest.count == 3) durations[1] = shortest.items[1].duration_s;
    return durations;
}

double storedAt(const Plan& plan, double capacitorVoltage) noexcept {
    return plan.circuit.hasCapacitor() ? 0.5 * plan.circuit.capacitance_F * capacitorVoltage * capacitorVoltage : 0;
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

namespace {

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

/// Worst over every state in which a train can find the load. A linear load's state moves toward its steady one
/// monotonically, and all figures are convex in it, so the ends of the range hold the worst.
Run worstOfStates(const Plan& plan, double carried) noexcept {
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

/// What a capacitor may hold, V.
struct Held {
    double least = 0, most = 0;
    void include(double voltage) noexcept {
        // NaN is kept: a run from it is refused.
        least = std::isnan(voltage) || voltage < least ? voltage : least;
        most = std::isnan(voltage) || voltage > most ? voltage : most;
    }
};

/// The most that one segment gives, whatever of `held` it begins with and however long it lasts. The current is linear
/// in what the capacitor holds and squares are convex, so the ends of `held` have the most; a longer segment adds to a
/// sum of squares. `held` becomes what the capacitor may hold afterwards, which is monotonic in start and time.
struct Most {
    double squares = 0, volts = 0, dissipated = 0;
    Most& operator+=(const Most& other) noexcept {
        squares += other.squares;
        volts += other.volts;
        dissipated += other.dissipated;
        return *this;
    }
};
Most mostOf(const Plan& plan, DriveSegment segment, double least_s, double most_s, Held& held) noexcept {
    Most most;
    Held after{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const double start : {held.least, held.most}) {
        segment.duration_s = most_s;
        const SegmentResponse longest = respond(plan.circuit, segment, start, plan.limits);
        double squares = 0, energy = 0;
        for (const ResponsePiece& piece : longest.pieces()) {
            squares += piece.currentSquared();
            energy += piece.energy();
        }
        most.squares = larger(squares, most.squares);
        most.volts = larger(voltageSquared(longest), most.volts);
        most.dissipated =
            larger(energy + storedAt(plan, start) - storedAt(plan, longest.endCapacitorVoltage), most.dissipated);
        after.include(longest.endCapacitorVoltage);
        segment.duration_s = least_s;
        after.include(respond(plan.circuit, segment, start, plan.limits).endCapacitorVoltage);
    }
    held = after;
    return most;
}

/// Upper bounds of the sums of squares over every train of the range that finds the load with any of `held`, which
/// becomes what it leaves when the next train begins.
Run enclosedFrom(const Plan& plan, Held& held) noexcept {
    Run run;
    double stored = larger(storedAt(plan, held.least), storedAt(plan, held.most));
    const auto add = [&](const DriveSegment& segment, double least_s, double most_s, Most& to) {
        to += mostOf(plan, segment, least_s, most_s, held);
        stored = larger(larger(storedAt(plan, held.least), storedAt(plan, held.most)), stored);
    };
    TrainSums& sums = run.inDuration;
    for (int done = 0; done < plan.pulses;) {
        const Held found = held;
        Most pulse;
        for (std::size_t s = 0; s < plan.pulse.count; ++s)
            add(plan.pulse.items[s], plan.leastPulse_s[s], plan.pulse.items[s].duration_s, pulse);
        add(plan.betweenPulses, plan.betweenPulses.duration_s, plan.mostBetweenPulses_s, pulse);
        const double moved = larger(std::abs(held.least - found.least), std::abs(held.most - found.most));
        const int alike = moved <= 1e-12 * larger(held.most, -held.least) ? plan.pulses - done : 1;
        done += alike;
        run.squares = larger(pulse.squares, run.squares);
        run.volts = larger(pulse.volts, run.volts);
        run.dissipated = larger(pulse.dissipated, run.dissipated);
        sums.currentSquared_A2s += alike * pulse.squares;
        sums.voltageSquared_V2s += alike * pulse.volts;
        sums.dissipated_J += alike * pulse.dissipated;
    }
    Most tail;
    add(plan.afterTrain, plan.afterTrain.duration_s, plan.afterTrain.duration_s, tail);
    run.squares += tail.squares;
    run.volts += tail.volts;
    run.dissipated += tail.dissipated;
    sums.stored_J = stored;
    run.whole = sums;
    run.whole.currentSquared_A2s += tail.squares;
    run.whole.voltageSquared_V2s += tail.volts;
    run.whole.dissipated_J += tail.dissipated;
    return run;
}

Run unknownRun() noexcept {
    Run run;
    run.squares = run.volts = run.dissipated = kNaN;
    run.inDuration = run.whole = {kNaN, kNaN, kNaN, kNaN, kNaN};
    return run;
}

/// The same for any number of trains, the first of which finds up to `carried` on the load. What holds more bounds
/// more: the widest run is the bound of all.
Run enclosed(const Plan& plan, double carried) noexcept {
    Held first{-carried, carried};
    Held once = first;
    const Run fromFirst = enclosedFrom(plan, once);
    const auto within = [](const Held& inner, const Held& outer, double slack) {
        return inner.least >= outer.least - slack && inner.most <= outer.most + slack;
    };
    const double small = 1e-12 * larger(once.most, -once.least);
    if (within(once, first, small)) return fromFirst;
    Held second = first;
    second.include(once.least);
    second.include(once.most);
    Held twice = second;
    const Run fromSecond = enclosedFrom(plan, twice);
    if (within(twice, second, small)) return fromSecond;
    // Each end maps linearly from train to train: end' = end(0) + slope * end, towards a steady one.
    const auto steady = [](double from, double to, double fromNext, double toNext) {
        const double slope = fromNext == from ? 0 : (toNext - to) / (fromNext - from);
        return slope < 1 ? from + (to - from) / (1 - slope) : kNaN;
    };
    second.include(steady(first.least, once.least, second.least, twice.least));
    second.include(steady(first.most, once.most, second.most, twice.most));
    Held last = second;
    const Run fromLast = enclosedFrom(plan, last);
    // Beyond its compliance a source is not linear; what is not enclosed then is not known, and refused.
    if (!within(last, second, 1e-6 * larger(second.most, -second.least))) return unknownRun();
    return fromLast;
}

}  // namespace

Run worstRun(const Plan& plan, double carried) noexcept {
    const Run worst = worstOfStates(plan, carried);
    const bool spread = plan.mostBetweenPulses_s > plan.betweenPulses.duration_s;
    return spread && plan.circuit.hasCapacitor() ? largerRun(worst, enclosed(plan, carried)) : worst;
}

}  // namespace tacto::exposure
