#include "core/safety/ExposureRun.h"

#include <algorithm>
#include <limits>

#include "core/base/Statistics.h"

namespace tacto::exposure {

std::array<double, 3> leastDurations(const PulseSegments& densest, const PulseSegments& sparsest) noexcept {
    std::array<double, 3> durations{};
    durations[0] = sparsest.items[0].duration_s;
    if (densest.count > 1) durations[densest.count - 1] = sparsest.items[sparsest.count - 1].duration_s;
    if (sparsest.count == 3) durations[1] = sparsest.items[1].duration_s;
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
    r.pulse = larger(a.pulse, b.pulse);
    r.cut = larger(a.cut, b.cut);
    r.cutTrain = larger(a.cutTrain, b.cutTrain);
    r.inDuration = largerSums(a.inDuration, b.inDuration);
    r.whole = largerSums(a.whole, b.whole);
    r.endOfTrain = larger(std::abs(a.endOfTrain), std::abs(b.endOfTrain));
    r.endOfInterval = larger(std::abs(a.endOfInterval), std::abs(b.endOfInterval));
    return r;
}

namespace {

/// The range of voltages that a capacitor may hold, V.
struct Held {
    double least = 0, most = 0;
    void include(double voltage) noexcept {
        // Keep NaN: a run from NaN is refused.
        least = std::isnan(voltage) || voltage < least ? voltage : least;
        most = std::isnan(voltage) || voltage > most ? voltage : most;
    }
};

constexpr double kAlike = 1e-12;  // voltages that differ by less, relative to the largest, are treated as equal
constexpr Held kNothing{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

double voltageSquared(const SegmentResponse& response) noexcept {
    double sum = 0;
    for (ResponsePiece piece : response.pieces()) {
        piece.i = piece.v;  // makes currentSquared() integrate v² instead of i²
        sum += piece.currentSquared();
    }
    return sum;
}

/// Returns the sums over a segment in which the capacitor started at `start`.
Sums sumsOf(const Plan& plan, const SegmentResponse& response, double start) noexcept {
    Sums sums{0, voltageSquared(response), storedAt(plan, start) - storedAt(plan, response.endCapacitorVoltage)};
    for (const ResponsePiece& piece : response.pieces()) {
        sums.squares += piece.currentSquared();
        sums.dissipated += piece.energy();
    }
    return sums;
}

void addTo(TrainSums& total, const Sums& sums, double times = 1) noexcept {
    total.currentSquared_A2s += times * sums.squares;
    total.voltageSquared_V2s += times * sums.volts;
    total.dissipated_J += times * sums.dissipated;
}

/// Returns how much a cut stretch may exceed either of two similar ones: late(a) + early(b) = a + early(b) - early(a).
/// With f the square of a quantity x, the integral of |f_b - f_a| is at most 2 sqrt(most) |x_b - x_a| (Cauchy-Schwarz).
/// `difference` has the sums of x_b - x_a; heat is the sum of two squares. At most the stretch itself.
Sums extraOfCut(const Sums& most, const Sums& difference) noexcept {
    const auto of = [](double sum, double apart) {
        const double bound = 2 * std::sqrt(sum * apart);
        return bound > sum ? sum : bound;  // NaN is kept
    };
    return {of(most.squares, difference.squares), of(most.volts, difference.volts),
            of(most.dissipated, difference.dissipated)};
}

/// Returns sums of the difference between two responses to one drive, with capacitors that start `apart` V apart. For
/// a linear load this is its response without a drive. Beyond the compliance it never grows either, and the currents
/// differ by at most `apart` divided by the series resistance.
Sums differenceBound(const Plan& plan, double seconds, double apart) noexcept {
    const double square = apart * apart * seconds;
    const double rs = plan.circuit.seriesOhm, rp = plan.circuit.parallelOhm;
    return {square / (rs * rs), square, square * (1 / rs + 1 / rp)};
}

/// The parts of a train's pulses, which differ because each pulse finds another voltage on the capacitor.
class PulseParts {
public:
    static constexpr std::size_t kRest = 3;  // the rest follows the pulse's segments (at most three)
    explicit PulseParts(const Plan& plan) noexcept : plan_(plan) {}

    /// Adds one segment of a pulse, for a capacitor that starts anywhere in `held`.
    void add(std::size_t segment, const Held& held, const Sums& sums) noexcept {
        Part& part = parts_[segment];
        part.most = larger(sums, part.most);
        part.held.include(held.least);
        part.held.include(held.most);
    }
    /// Returns the largest sums of one pulse.
    [[nodiscard]] Sums pulse() const noexcept {
        Sums sum;
        for (const Part& part : parts_) sum += part.most;
        return sum;
    }
    /// Returns how much a stretch of n periods may exceed n pulses if it begins late in a part of one pulse and ends
    /// early in the same part of another.
    [[nodiscard]] Sums cut() const noexcept {
        double largest = 0;
        for (const Part& part : parts_) largest = larger(larger(part.held.most, -part.held.least), largest);
        Sums most;
        for (std::size_t s = 0; s < kParts; ++s) {
            const double apart = parts_[s].held.most - parts_[s].held.least;
            if (apart <= kAlike * largest) continue;  // also if no pulse has this part
            DriveSegment segment = plan_.betweenPulses;
            segment.duration_s = plan_.mostBetweenPulses_s;
            if (s < kRest) segment = plan_.pulse.items[s];
            most = larger(extraOfCut(parts_[s].most, differenceOver(segment, apart)), most);
        }
        return most;
    }

private:
    static constexpr std::size_t kParts = kRest + 1;
    struct Part {
        Sums most;
        Held held = kNothing;
    };
    [[nodiscard]] Sums differenceOver(DriveSegment segment, double apart) const noexcept {
        if (!std::isinf(plan_.limits.compliance_V)) return differenceBound(plan_, segment.duration_s, apart);
        segment.start = segment.end = 0;
        // Rounding may give a value below 0.
        return larger(sumsOf(plan_, respond(plan_.circuit, segment, apart), apart), Sums{});
    }
    const Plan& plan_;
    std::array<Part, kParts> parts_{};
};

PulsePart partOf(const PulseSegments& pulse, std::size_t s) noexcept {
    if (s == 0) return PulsePart::LeadingPhase;
    return s + 1 == pulse.count ? PulsePart::SecondPhase : PulsePart::Gap;
}

Run runFrom(const Plan& plan, double capacitorVoltage) noexcept {
    Run run;
    PulseParts parts(plan);
    double stored = storedAt(plan, capacitorVoltage);
    for (int done = 0; done < plan.pulses;) {
        PulseResponse response(plan.circuit, plan.limits, capacitorVoltage);
        const PulseTotals& totals = response.totals();
        Sums pulse;
        const auto add = [&](const DriveSegment& segment, PulsePart part) {
            const PulseTotals before = totals;
            Sums sums;
            sums.volts = voltageSquared(response.add(segment, part));
            sums.squares = totals.currentSquared_A2s - before.currentSquared_A2s;
            sums.dissipated = totals.energy_J - before.energy_J + storedAt(plan, before.endCapacitorVoltage) -
                              storedAt(plan, totals.endCapacitorVoltage);
            pulse += sums;
            return sums;
        };
        for (std::size_t s = 0; s < plan.pulse.count; ++s) {
            const double found = response.capacitorVoltage();
            parts.add(s, {found, found}, add(plan.pulse.items[s], partOf(plan.pulse, s)));
            stored = larger(storedAt(plan, response.capacitorVoltage()), stored);
        }
        const double rested = response.capacitorVoltage();
        Sums rest;
        if (plan.betweenPulses.duration_s > 0) rest = add(plan.betweenPulses, PulsePart::Rest);

        // Once a pulse leaves the capacitor as it found it, all later pulses are the same.
        const double moved = std::abs(response.capacitorVoltage() - capacitorVoltage);
        const bool settled = moved <= kAlike * totals.peakVoltage_V;
        const int alike = settled ? plan.pulses - done : 1;
        done += alike;

        run.peakVoltage = larger(totals.peakVoltage_V, run.peakVoltage);
        run.peakCurrent = larger(totals.peakCurrent_A, run.peakCurrent);
        run.phaseCharge = larger(totals.phaseCharge_C(), run.phaseCharge);
        run.netCharge = larger(std::abs(totals.netCharge_C), run.netCharge);
        run.energy = larger(totals.energy_J, run.energy);
        run.inDuration.netCharge_C += alike * std::abs(totals.netCharge_C);
        addTo(run.inDuration, pulse, alike);
        run.inDuration.stored_J = stored;
        capacitorVoltage = response.capacitorVoltage();

        if (done >= plan.pulses) {
            run.endOfTrain = capacitorVoltage;
            run.whole = run.inDuration;
            if (plan.afterTrain.duration_s > 0) {
                PulseResponse tail(plan.circuit, plan.limits, capacitorVoltage);
                const Sums sums = sumsOf(plan, tail.add(plan.afterTrain, PulsePart::Rest), capacitorVoltage);
                const PulseTotals& after = tail.totals();
                rest += sums;
                addTo(run.whole, sums);
                run.peakCurrent = larger(after.peakCurrent_A, run.peakCurrent);
                // The last pulse has a longer tail than the others, unless the next train comes early: take the larger.
                const double before = std::abs(totals.netCharge_C);
                const double last = std::abs(totals.netCharge_C + after.netCharge_C);
                run.netCharge = larger(last, run.netCharge);
                run.whole.netCharge_C += larger(last, before) - before;
                run.energy = larger(totals.energy_J + after.energy_J, run.energy);
                capacitorVoltage = tail.capacitorVoltage();
            }
            run.endOfInterval = capacitorVoltage;
        }
        parts.add(PulseParts::kRest, {rested, rested}, rest);
    }
    run.pulse = parts.pulse();
    run.cut = parts.cut();
    return run;
}

/// Like Run::cut, for a window that begins in one train and ends in another; the voltages that the two trains found
/// differ by up to `apart` V.
Sums cutBetween(const Plan& plan, const Run& worst, double apart) noexcept {
    const auto sumsIn = [](const TrainSums& all) {
        return Sums{all.currentSquared_A2s, all.voltageSquared_V2s, all.dissipated_J};
    };
    const Sums train = sumsIn(worst.whole);
    if (!std::isinf(plan.limits.compliance_V)) {
        double pulse_s = plan.mostBetweenPulses_s;
        for (const DriveSegment& segment : plan.pulse.span()) pulse_s += segment.duration_s;
        return extraOfCut(train, differenceBound(plan, plan.pulses * pulse_s + plan.afterTrain.duration_s, apart));
    }
    Plan undriven = plan;
    for (DriveSegment& segment : undriven.pulse.items) segment.start = segment.end = 0;
    return extraOfCut(train, larger(sumsIn(runFrom(undriven, apart).whole), Sums{}));
}

/// Returns the share of the capacitor's voltage at the start of a train that is left when the next train begins.
double slopeOf(const Plan& plan, const Run& rested) noexcept {
    if (!std::isinf(plan.limits.compliance_V)) {
        const double probe = rested.peakVoltage;
        return (runFrom(plan, probe).endOfInterval - rested.endOfInterval) / probe;
    }
    const double rs = plan.circuit.seriesOhm, rp = plan.circuit.parallelOhm;
    const auto decays = [&](const DriveSegment& segment) {  // in time constants; R_s matters only for a voltage source
        const double ohm = segment.drive == Drive::Voltage ? rs * rp / (rs + rp) : rp;
        return segment.duration_s / (ohm * plan.circuit.capacitance_F);
    };
    double pulse = decays(plan.betweenPulses);
    for (const DriveSegment& segment : plan.pulse.span()) pulse += decays(segment);
    return std::exp(-(plan.pulses * pulse + decays(plan.afterTrain)));
}

/// Worst over every state in which a train can find the load. A linear load moves monotonically to its steady state,
/// and all figures are convex in the state, so the ends of the range are the worst. `found` becomes that range.
Run worstOfStates(const Plan& plan, double carried, Held& found) noexcept {
    const Run rested = runFrom(plan, 0);
    Run worst = rested;
    if (!plan.circuit.hasCapacitor()) return worst;
    const double small = kAlike * rested.peakVoltage;
    if (!(std::abs(rested.endOfInterval) <= small)) {
        // The state maps linearly from train to train: x' = f(0) + slope·x.
        const double slope = slopeOf(plan, rested);
        // Below 1 if charge can leak; a load that only collects has no steady state: NaN leads to a refusal.
        const double steady = slope < 1 ? rested.endOfInterval / (1 - slope) : kNaN;
        worst = largerRun(worst, runFrom(plan, steady));
        found.include(steady);
    }
    if (!(carried <= small)) {
        worst = largerRun(worst, largerRun(runFrom(plan, carried), runFrom(plan, -carried)));
        found.include(carried);
        found.include(-carried);
    }
    return worst;
}

/// Returns the most that one segment can give, from any start in `held` and for any length. The current is linear in
/// the capacitor's voltage and squares are convex, so the ends of `held` give the most; a longer segment adds more
/// squares. `held` becomes the range of voltages afterwards, which is monotonic in start and time.
Sums mostOf(const Plan& plan, DriveSegment segment, double least_s, double most_s, Held& held) noexcept {
    Sums most;
    Held after = kNothing;
    for (const double start : {held.least, held.most}) {
        segment.duration_s = most_s;
        const SegmentResponse longest = respond(plan.circuit, segment, start, plan.limits);
        most = larger(sumsOf(plan, longest, start), most);
        after.include(longest.endCapacitorVoltage);
        segment.duration_s = least_s;
        after.include(respond(plan.circuit, segment, start, plan.limits).endCapacitorVoltage);
    }
    held = after;
    return most;
}

/// Returns upper bounds of the sums of squares over every train of the range, from any start in `held`. `held`
/// becomes the range of voltages when the next train begins.
Run enclosedFrom(const Plan& plan, Held& held) noexcept {
    Run run;
    PulseParts parts(plan);
    double stored = larger(storedAt(plan, held.least), storedAt(plan, held.most));
    const auto add = [&](const DriveSegment& segment, double least_s, double most_s) {
        const Sums most = mostOf(plan, segment, least_s, most_s, held);
        stored = larger(larger(storedAt(plan, held.least), storedAt(plan, held.most)), stored);
        return most;
    };
    Sums tail;
    for (int done = 0; done < plan.pulses;) {
        const Held found = held;
        Sums pulse;
        for (std::size_t s = 0; s < plan.pulse.count; ++s) {
            const Held before = held;
            const Sums most = add(plan.pulse.items[s], plan.leastPulse_s[s], plan.pulse.items[s].duration_s);
            parts.add(s, before, most);
            pulse += most;
        }
        const Held rested = held;
        Sums rest = add(plan.betweenPulses, plan.betweenPulses.duration_s, plan.mostBetweenPulses_s);
        pulse += rest;
        const double moved = larger(std::abs(held.least - found.least), std::abs(held.most - found.most));
        const int alike = moved <= kAlike * larger(held.most, -held.least) ? plan.pulses - done : 1;
        done += alike;
        addTo(run.inDuration, pulse, alike);
        if (done >= plan.pulses) {
            tail = add(plan.afterTrain, plan.leastAfterTrain_s, plan.afterTrain.duration_s);
            rest += tail;
        }
        parts.add(PulseParts::kRest, rested, rest);
    }
    run.pulse = parts.pulse();
    run.cut = parts.cut();
    run.inDuration.stored_J = stored;
    run.whole = run.inDuration;
    addTo(run.whole, tail);
    return run;
}

Run unknownRun() noexcept {
    Run run;
    run.pulse = run.cut = {kNaN, kNaN, kNaN};
    run.inDuration = run.whole = {kNaN, kNaN, kNaN, kNaN, kNaN};
    return run;
}

/// Returns the voltage at which the capacitor holds this energy.
double voltageOf(const Plan& plan, double stored_J) noexcept {
    return plan.circuit.hasCapacitor() ? std::sqrt(2 * stored_J / plan.circuit.capacitance_F) : 0;
}

/// Returns the bounds for any number of trains, if the first finds up to `carried` on the load. A wider range of
/// voltages gives larger bounds, so the widest range bounds all trains.
Run enclosed(const Plan& plan, double carried) noexcept {
    // Each end maps linearly from train to train: end' = end(0) + slope * end, towards a steady end. On the way another
    // duration may give the end, and with it another slope.
    constexpr int kMaxSlopes = 8;
    constexpr double kRounding = 1e-15;  // share of the voltage to which a phase charges the capacitor
    double rounding = 0;
    for (const DriveSegment& phase : plan.pulse.span()) {
        const double ohm = phase.drive == Drive::Current ? plan.circuit.parallelOhm : 1;
        rounding = std::max(rounding, kRounding * ohm * std::abs(phase.start));
    }
    Held found{-carried, carried};
    for (int tries = 0; tries < kMaxSlopes; ++tries) {
        Held left = found;
        const Run run = enclosedFrom(plan, left);
        const double small = kAlike * voltageOf(plan, run.whole.stored_J) + rounding;
        const auto within = [small](const Held& inner, const Held& outer) {
            return inner.least >= outer.least - small && inner.most <= outer.most + small;
        };
        if (within(left, found)) return run;
        Held next = found;
        next.include(left.least);
        next.include(left.most);
        Held leftNext = next;
        const Run runNext = enclosedFrom(plan, leftNext);
        if (within(leftNext, next)) return runNext;
        const auto steady = [small](double from, double to, double fromNext, double toNext) {
            if (std::abs(fromNext - from) <= small) return fromNext;
            const double slope = (toNext - to) / (fromNext - from);
            return slope < 1 ? from + (to - from) / (1 - slope) : kNaN;
        };
        next.include(steady(found.least, left.least, next.least, leftNext.least));
        next.include(steady(found.most, left.most, next.most, leftNext.most));
        found = next;
    }
    // Beyond its compliance a source is not linear; if no bound is found, the result is unknown and refused.
    return unknownRun();
}

}  // namespace

Run worstRun(const Plan& plan, double carried) noexcept {
    Held found;
    Run worst = worstOfStates(plan, carried, found);
    const bool spread = plan.mostBetweenPulses_s > plan.betweenPulses.duration_s;
    if (spread && plan.circuit.hasCapacitor()) worst = largerRun(worst, enclosed(plan, carried));
    const double apart = found.most - found.least;
    if (!(apart <= kAlike * worst.peakVoltage)) worst.cutTrain = cutBetween(plan, worst, apart);
    return worst;
}

}  // namespace tacto::exposure
