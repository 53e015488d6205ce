#include "core/electrode/LoadResponse.h"

#include <algorithm>
#include <cmath>

namespace tacto {

namespace {

/// exp(−t/τ); τ = 0 means that this part has already died out.
double decay(double t, double tau) noexcept { return tau > 0 ? std::exp(-t / tau) : 0.0; }

double valueOf(const ExpCurve& f, double tau, double t) noexcept { return f.a + f.b * t + f.c * decay(t, tau); }

/// 1 − exp(−x), computed without cancellation.
double risen(double x) noexcept { return -std::expm1(-x); }

/// ∫₀ᵀ exp(−t/τ) dt
double integralOfDecay(double T, double tau) noexcept { return tau > 0 ? tau * risen(T / tau) : 0.0; }

/// ∫₀ᵀ t·exp(−t/τ) dt = τ²(1 − e^−x (1 + x)), x = T/τ; for small x a series replaces the difference.
double integralOfTimeDecay(double T, double tau) noexcept {
    if (!(tau > 0)) return 0.0;
    const double x = T / tau;
    if (x < 1e-2) return T * T * (0.5 + x * (-1.0 / 3 + x * (0.125 + x * (-1.0 / 30 + x / 144))));
    return tau * tau * (risen(x) - x * std::exp(-x));
}

double integralOf(const ExpCurve& f, double tau, double T) noexcept {
    return f.a * T + f.b * T * T / 2 + f.c * integralOfDecay(T, tau);
}

/// ∫₀ᵀ f·g dt
double integralOfProduct(const ExpCurve& f, const ExpCurve& g, double tau, double T) noexcept {
    return f.a * g.a * T + (f.a * g.b + f.b * g.a) * T * T / 2 + f.b * g.b * T * T * T / 3 +
           (f.a * g.c + f.c * g.a) * integralOfDecay(T, tau) + (f.b * g.c + f.c * g.b) * integralOfTimeDecay(T, tau) +
           f.c * g.c * integralOfDecay(T, tau / 2);
}

/// Returns the only moment inside (0, T) at which f' = 0, or −1.
double turningPoint(const ExpCurve& f, double tau, double T) noexcept {
    if (!(tau > 0) || f.c == 0 || f.b == 0) return -1;
    const double ratio = f.b * tau / f.c;  // exp(−t/τ) at the turning point
    if (!(ratio > 0) || !(ratio < 1)) return -1;
    const double t = -tau * std::log(ratio);
    return t > 0 && t < T ? t : -1;
}

double largestMagnitude(const ExpCurve& f, double tau, double T) noexcept {
    double largest = std::max(std::abs(valueOf(f, tau, 0)), std::abs(valueOf(f, tau, T)));
    const double turn = turningPoint(f, tau, T);
    if (turn > 0) largest = std::max(largest, std::abs(valueOf(f, tau, turn)));
    return largest;
}

/// Returns the first t in [0, T] from which f rises above `tolerance`, or −1. f has at most one turning point, so each
/// side of it has at most one crossing, and bisection there is reliable.
double firstRise(const ExpCurve& f, double tau, double T, double tolerance) noexcept {
    const double turn = turningPoint(f, tau, T);
    double from = 0;
    if (valueOf(f, tau, 0) > tolerance) return 0;
    for (const double to : {turn > 0 ? turn : T, T}) {
        if (valueOf(f, tau, to) > tolerance) {
            double low = from;
            double high = to;
            for (int step = 0; step < 200; ++step) {
                const double middle = low + (high - low) / 2;
                if (middle <= low || middle >= high) break;
                (valueOf(f, tau, middle) > tolerance ? high : low) = middle;
            }
            return high;
        }
        from = to;
    }
    return -1;
}

ExpCurve difference(const ExpCurve& f, const ExpCurve& g) noexcept { return {f.a - g.a, f.b - g.b, f.c - g.c}; }
ExpCurve times(double factor, const ExpCurve& f) noexcept { return {factor * f.a, factor * f.b, factor * f.c}; }

/// The response to a level a + b·t imposed on the circuit. `vc` is the voltage of the capacitor.
struct Regime {
    double tau = 0;
    ExpCurve v, i, vc;
};

Regime underVoltage(const Circuit& z, double level, double slope, double vc0) noexcept {
    Regime r;
    r.v = {level, slope, 0};
    if (!z.hasCapacitor()) {
        r.i = times(1 / z.seriesOhm, r.v);
        return r;
    }
    const double k = z.parallelOhm / (z.seriesOhm + z.parallelOhm);
    r.tau = k * z.seriesOhm * z.capacitance_F;
    const double settled = k * (level - slope * r.tau);  // the value of vc at t = 0 without the transient
    r.vc = {settled, k * slope, vc0 - settled};
    r.i = times(1 / z.seriesOhm, difference(r.v, r.vc));
    return r;
}

Regime underCurrent(const Circuit& z, double level, double slope, double vc0) noexcept {
    Regime r;
    r.i = {level, slope, 0};
    if (z.hasCapacitor()) {
        r.tau = z.parallelOhm * z.capacitance_F;
        const double settled = z.parallelOhm * (level - slope * r.tau);
        r.vc = {settled, z.parallelOhm * slope, vc0 - settled};
    }
    r.v = {z.seriesOhm * level + r.vc.a, z.seriesOhm * slope + r.vc.b, r.vc.c};
    return r;
}

Regime whileOpen(const Circuit& z, double level, double slope, double vc0) noexcept {
    Regime r;
    r.v = {level, slope, 0};
    if (z.hasCapacitor()) {
        r.tau = z.parallelOhm * z.capacitance_F;
        r.vc = {0, 0, vc0};
    }
    return r;
}

/// Builds a SegmentResponse piece by piece.
class Builder {
public:
    Builder(const Circuit& circuit, const SourceLimits& limits, double vc) noexcept
        : circuit_(circuit), limits_(limits), vc_(vc) {}

    /// Adds pieces for a source that requests level + slope·t for `T`, within its own range.
    /// Leaves `reserve` pieces free for later calls.
    void drive(Drive drive, double level, double slope, double T, std::size_t reserve) noexcept {
        double t = 0;
        bool limited = false;
        double sign = 0;  // sign of the active limit
        while (t < T || T == 0) {
            const bool last = out_.count + 1 + reserve >= SegmentResponse::kMaxPieces;
            const double now = level + slope * t;
            const Regime wanted = drive == Drive::Voltage ? underVoltage(circuit_, now, slope, vc_)
                                                          : underCurrent(circuit_, now, slope, vc_);
            const ExpCurve& watched = drive == Drive::Voltage ? wanted.i : wanted.v;
            const double limit = drive == Drive::Voltage ? limits_.current_A : limits_.compliance_V;
            double change = -1;
            if (!limited) {
                change = firstExceeding(watched, wanted.tau, T - t, limit, sign);
                if (change == 0 && !last) {
                    limited = true;
                    continue;
                }
                emit(wanted, last || change < 0 ? T - t : change, false);
            } else {
                const Regime held = drive == Drive::Voltage ? underCurrent(circuit_, sign * limit, 0, vc_)
                                                            : underVoltage(circuit_, sign * limit, 0, vc_);
                // The limit holds until the other quantity reaches the requested value.
                const ExpCurve asked{now, slope, 0};
                const ExpCurve reached = drive == Drive::Voltage ? held.v : held.i;
                const double scale = std::abs(now) + std::abs(slope) * T;
                change = firstRise(times(sign, difference(reached, asked)), held.tau, T - t, 1e-12 * scale);
                if (change == 0) change = -1;  // this is the crossing at which the regime began
                emit(held, last || change < 0 ? T - t : change, true);
            }
            if (change < 0 || last) return;
            t += change;
            limited = !limited;
        }
    }

    void open(Drive drive, double level, double slope, double T) noexcept {
        if (drive == Drive::Voltage) {
            emit(whileOpen(circuit_, level, slope, vc_), T, false);
            return;
        }
        // A current source finds no path, so its voltage goes to its compliance, on the requested side.
        const double middle = level + slope * T / 2;
        const bool stated = std::isfinite(limits_.compliance_V) && middle != 0;
        emit(whileOpen(circuit_, stated ? std::copysign(limits_.compliance_V, middle) : 0.0, 0, vc_), T, stated);
    }

    void highImpedance(double T) noexcept {
        emit(circuit_.open ? whileOpen(circuit_, 0, 0, vc_) : underCurrent(circuit_, 0, 0, vc_), T, false);
    }

    [[nodiscard]] SegmentResponse finish() noexcept {
        out_.endCapacitorVoltage = vc_;
        return out_;
    }

private:
    /// Returns the time when |f| first exceeds `limit` (`sign`: on which side), or −1.
    static double firstExceeding(const ExpCurve& f, double tau, double T, double limit, double& sign) noexcept {
        if (!std::isfinite(limit)) return -1;
        double first = -1;
        for (const double side : {1.0, -1.0}) {
            ExpCurve over = times(side, f);
            over.a -= limit;
            const double t = firstRise(over, tau, T, 1e-12 * limit);
            if (t >= 0 && (first < 0 || t < first)) {
                first = t;
                sign = side;
            }
        }
        return first;
    }

    void emit(const Regime& regime, double T, bool limited) noexcept {
        if (out_.count >= SegmentResponse::kMaxPieces) return;
        auto& piece = out_.items[out_.count++];
        piece = {elapsed_, T, regime.tau, regime.v, regime.i, limited};
        elapsed_ += T;
        vc_ = circuit_.hasCapacitor() ? valueOf(regime.vc, regime.tau, T) : 0.0;
    }

    const Circuit& circuit_;
    const SourceLimits& limits_;
    double vc_;
    double elapsed_ = 0;
    SegmentResponse out_;
};

/// The moments in (0, T) at which a ramp from `start` to `end` crosses ± `limit` or, if asked for, 0.
struct RampCuts {
    std::array<double, 3> at{};
    std::size_t count = 0;
};
RampCuts cutsOf(double start, double end, double T, double limit, bool atZero) noexcept {
    RampCuts cuts;
    if (start == end) return cuts;
    const auto consider = [&](double level) {
        const double t = T * ((level - start) / (end - start));
        if (!(t > 0 && t < T) || cuts.count == cuts.at.size()) return;
        std::size_t place = cuts.count++;
        for (; place > 0 && cuts.at[place - 1] > t; --place) cuts.at[place] = cuts.at[place - 1];
        cuts.at[place] = t;
    };
    if (std::isfinite(limit)) {
        consider(limit);
        consider(-limit);
    }
    if (atZero) consider(0);
    return cuts;
}

}  // namespace

SegmentResponse respond(const Circuit& circuit, const DriveSegment& segment, double capacitorVoltage,
                        const SourceLimits& limits) noexcept {
    Builder build(circuit, limits, circuit.hasCapacitor() ? capacitorVoltage : 0.0);
    const double T = segment.duration_s;
    if (segment.drive == Drive::HighImpedance) {
        build.highImpedance(T);
        return build.finish();
    }
    // A source cannot deliver more than its limit, so the ramp is cut where it reaches that limit.
    const double own = segment.drive == Drive::Voltage ? limits.compliance_V : limits.current_A;
    const RampCuts cuts = cutsOf(segment.start, segment.end, T, own, circuit.open && segment.drive == Drive::Current);
    const double slope = T > 0 ? (segment.end - segment.start) / T : 0.0;
    double from = 0;
    for (std::size_t cut = 0; cut <= cuts.count; ++cut) {
        const double to = cut < cuts.count ? cuts.at[cut] : T;
        const double middle = segment.start + slope * (from + to) / 2;
        const bool beyond = std::abs(middle) > own;
        const double level = beyond ? std::copysign(own, middle) : segment.start + slope * from;
        const double rise = beyond ? 0.0 : slope;
        if (circuit.open) {
            build.open(segment.drive, level, rise, to - from);
        } else {
            build.drive(segment.drive, level, rise, to - from, cuts.count - cut);
        }
        from = to;
    }
    return build.finish();
}

double ResponsePiece::voltage(double t_s) const noexcept { return valueOf(v, tau_s, t_s); }
double ResponsePiece::current(double t_s) const noexcept { return valueOf(i, tau_s, t_s); }
double ResponsePiece::charge() const noexcept { return integralOf(i, tau_s, duration_s); }
double ResponsePiece::currentSquared() const noexcept { return integralOfProduct(i, i, tau_s, duration_s); }
double ResponsePiece::energy() const noexcept { return integralOfProduct(v, i, tau_s, duration_s); }
double ResponsePiece::peakVoltage() const noexcept { return largestMagnitude(v, tau_s, duration_s); }
double ResponsePiece::peakCurrent() const noexcept { return largestMagnitude(i, tau_s, duration_s); }

namespace {
/// Returns the piece that covers `t_s`; the segment has at least one.
const ResponsePiece& pieceAt(const SegmentResponse& response, double t_s) noexcept {
    std::size_t index = 0;
    while (index + 1 < response.count && t_s >= response.items[index + 1].start_s) ++index;
    return response.items[index];
}
double within(const ResponsePiece& piece, double t_s) noexcept {
    return std::clamp(t_s - piece.start_s, 0.0, piece.duration_s);
}
}  // namespace

double SegmentResponse::voltage(double t_s) const noexcept {
    const auto& piece = pieceAt(*this, t_s);
    return piece.voltage(within(piece, t_s));
}

double SegmentResponse::current(double t_s) const noexcept {
    const auto& piece = pieceAt(*this, t_s);
    return piece.current(within(piece, t_s));
}

bool SegmentResponse::limited() const noexcept {
    const auto all = pieces();
    return std::any_of(all.begin(), all.end(), [](const ResponsePiece& piece) { return piece.limited; });
}

double PulseTotals::phaseCharge_C() const noexcept {
    return std::max(std::abs(leadingCharge_C), std::abs(secondCharge_C));
}

double PulseTotals::imbalance() const noexcept {
    const double phase = phaseCharge_C();
    return phase > 0 ? std::abs(netCharge_C) / phase : 0.0;
}

double PulseTotals::impedanceOhm() const noexcept {
    if (leadingEndCurrent_A == 0) return std::numeric_limits<double>::infinity();
    return std::abs(leadingEndVoltage_V / leadingEndCurrent_A);
}

PulseResponse::PulseResponse(const Circuit& circuit, const SourceLimits& limits, double capacitorVoltage) noexcept
    : circuit_(circuit), limits_(limits) {
    totals_.endCapacitorVoltage = circuit.hasCapacitor() ? capacitorVoltage : 0.0;
}

SegmentResponse PulseResponse::add(const DriveSegment& segment, PulsePart part) noexcept {
    const auto response = respond(circuit_, segment, totals_.endCapacitorVoltage, limits_);
    double charge = 0;
    for (const auto& piece : response.pieces()) {
        totals_.peakVoltage_V = std::max(totals_.peakVoltage_V, piece.peakVoltage());
        totals_.peakCurrent_A = std::max(totals_.peakCurrent_A, piece.peakCurrent());
        totals_.currentSquared_A2s += piece.currentSquared();
        totals_.energy_J += piece.energy();
        totals_.limited = totals_.limited || piece.limited;
        charge += piece.charge();
    }
    totals_.netCharge_C += charge;
    if (part == PulsePart::LeadingPhase) {
        totals_.leadingCharge_C += charge;
        totals_.leadingEndVoltage_V = response.voltage(segment.duration_s);
        totals_.leadingEndCurrent_A = response.current(segment.duration_s);
    } else if (part == PulsePart::SecondPhase) {
        totals_.secondCharge_C += charge;
    }
    totals_.endCapacitorVoltage = response.endCapacitorVoltage;
    return response;
}

void PulseResponse::addPulse(const PulseSegments& pulse, const DriveSegment& rest) noexcept {
    for (std::size_t s = 0; s < pulse.count; ++s) {
        const bool last = s + 1 == pulse.count;
        add(pulse.items[s], s == 0 ? PulsePart::LeadingPhase : last ? PulsePart::SecondPhase : PulsePart::Gap);
    }
    if (rest.duration_s > 0) add(rest, PulsePart::Rest);
}

void PulseResponse::restart() noexcept {
    const double kept = totals_.endCapacitorVoltage;
    totals_ = {};
    totals_.endCapacitorVoltage = kept;
}

PulseTotals pulseTotals(const Circuit& circuit, const PulseSegments& pulse, const DriveSegment& rest,
                        const SourceLimits& limits) noexcept {
    PulseResponse response(circuit, limits);
    response.addPulse(pulse, rest);
    return response.totals();
}

}  // namespace tacto
