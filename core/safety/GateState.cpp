#include "core/safety/GateState.h"

#include <algorithm>
#include <cmath>

#include "core/electrode/LoadResponse.h"

namespace tacto::gate {

// It is not known how long another source has been connected: charge left by a source that rests in high impedance may
// have stayed until now.
double State::carriedAt(Instant now) const noexcept {
    double left = 0;
    for (const GapState leftBy : {GapState::HoldsZero, GapState::HighImpedance}) {
        const ResidualVoltage& residual = residuals[static_cast<std::size_t>(leftBy)];
        if (residual.volts == 0 || now <= residual.at) {
            left = std::max(left, residual.volts);
            continue;
        }
        const bool floats = leftBy == GapState::HighImpedance || setup->source.gap == GapState::HighImpedance;
        const DriveSegment rest =
            restOf(floats ? GapState::HighImpedance : GapState::HoldsZero, Seconds(now - residual.at));
        for (const Load* end : {&load.min, &load.max}) {
            Load steady = *end;
            steady.driftPerSecond = steady.openFraction = 0;
            steady.windowCount = 0;
            left = std::max(left, respond(circuitAt(steady, 0), rest, residual.volts).endCapacitorVoltage);
        }
    }
    return left;
}

Load State::measuredLoad(Ohms magnitude) const noexcept {
    const Load& declared = setup->load.nominal;
    DriveSegment leading = segmentsOf(lastTrain, setup->source.gap).items[0];
    if (leading.start == 0) leading = segmentsOf(check, setup->source.gap).items[0];
    const double ratio = magnitude.value() / effectiveImpedance(declared, leading).value();
    return LoadRange::around(declared, ratio, ratio).min;
}

bool State::agreesWithDeclared(double ohm) const noexcept {
    // A reading belongs to a check pulse or to the last train, and |Z| depends on the pulse; so both are checked.
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (const PulseTrain* train : {&check, &lastTrain}) {
        const DriveSegment leading = segmentsOf(*train, setup->source.gap).items[0];
        if (leading.start == 0) continue;
        low = std::min(low, effectiveImpedance(load.min, leading).value());
        high = std::max(high, effectiveImpedance(load.max, leading).value());
    }
    return ohm >= low && ohm <= high;
}

}  // namespace tacto::gate
