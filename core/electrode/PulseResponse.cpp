#include "core/electrode/PulseResponse.h"

#include <algorithm>
#include <cmath>

namespace tacto {

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
