#include <algorithm>
#include <cmath>

#include "core/electrode/LoadResponse.h"
#include "core/safety/GateChecks.h"
#include "core/safety/GateState.h"

namespace tacto {

using namespace gate;

/// What is left of the residual voltage by `now`, on the load that keeps it longest.
double SafetyGate::State::carriedAt(Instant now) const noexcept {
    if (residual_V == 0 || now <= residualAt) return residual_V;
    double left = 0;
    const DriveSegment rest = restOf(setup->source.gap, Seconds(now - residualAt));
    for (const Load* end : {&load.min, &load.max}) {
        Load steady = *end;
        steady.driftPerSecond = steady.openFraction = 0;
        steady.windowCount = 0;
        left = std::max(left, respond(circuitAt(steady, 0), rest, residual_V).endCapacitorVoltage);
    }
    return left;
}

PulseTrain SafetyGate::State::judgedAs(const PulseTrain& train) const noexcept {
    const PulseTrain delivered = deliveredBy(train, setup->calibration);
    return siValue(delivered.amplitude) > siValue(train.amplitude) && checks(MoreThanTold) ? delivered : train;
}

PulseTrain SafetyGate::State::feltAs(const PulseTrain& train) const noexcept {
    const PulseTrain delivered = leastDeliveredBy(train, setup->calibration);
    return siValue(delivered.amplitude) < siValue(train.amplitude) ? delivered : train;
}

double SafetyGate::State::commandShare(const PulseTrain& train) const noexcept {
    const double told = siValue(train.amplitude);
    const double delivered = siValue(deliveredBy(train, setup->calibration).amplitude);
    const double judged = std::max(told, delivered);
    return judged > 0 ? (setup->calibrated ? delivered : told) / judged : 1;
}

Result<void> SafetyGate::State::judge(const TrainExposure& overRange, const TrainExposure& at500,
                                      const PulseTrain& judged, double share, Seconds interval,
                                      double carried_V) const {
    for (const ActiveLimit& limit : limits) {
        const LimitRow& row = limit.row;
        if (row.action != LimitAction::Refuse || !row.holdsAt(1 / interval.count())) continue;
        if (needsArea(row.quantity) && std::isnan(area)) continue;  // Reads "not evaluated"
        if (!checks(limitCheck(limit.ceiling ? RequestCeiling : RequestLimit, row.quantity))) continue;
        const bool into500 = row.judged == JudgedAt::Ohm500;
        const double value = (into500 ? at500 : overRange).at(row.quantity);
        if (keepsLimit(row, value, commandIsComputed())) continue;
        std::string aside = " into 500 ohm";
        if (!into500) {
            const double nominal =
                (row.quantity == Quantity::CommandVoltage ? share : 1) *
                exposureOf(judged, interval, load.nominal, setup->source, area, {carried_V}).at(row.quantity);
            aside = fmt::format(" in the worst case ({:.4g} {} into {})", nominal, unitOf(row.quantity),
                                load.nominal.text());
        }
        return fail(ErrorCode::LimitExceeded, "{}", refusalText(limit, value, aside));
    }
    return {};
}

Result<void> SafetyGate::State::judgeMetered(const TrainExposure& overRange, const TrainExposure& at500, double hz,
                                             Instant now) const {
    auto second = meter.couldShare(Seconds(1), now);
    auto five = meter.couldShare(Seconds(5), now);
    second.overRange += overRange.in1s;
    second.at500 += at500.in1s;
    five.overRange += overRange.in5s;
    five.at500 += at500.in5s;
    for (const ActiveLimit& limit : limits) {
        const LimitRow& row = limit.row;
        if (row.action != LimitAction::Refuse || windowOf(row.quantity) == 0) continue;
        const auto& sums = windowOf(row.quantity) == 1 ? second : five;
        // Trains of different rates share the window: every band that one of them belongs to holds.
        if (!row.holdsAt(hz) && !row.holdsAt(sums.lowestHz)) continue;
        if (needsArea(row.quantity) && std::isnan(area)) continue;
        if (!checks(limitCheck(limit.ceiling ? MeterCeiling : MeterLimit, row.quantity))) continue;
        const double value =
            windowedValue(row.quantity, row.judged == JudgedAt::Ohm500 ? sums.at500 : sums.overRange, area);
        if (!keepsLimit(row, value, false)) {
            return fail(ErrorCode::LimitExceeded, "{}",
                        refusalText(limit, value, fmt::format(" with the {} trains before it", sums.trains)));
        }
    }
    return {};
}

bool SafetyGate::State::agreesWithDeclared(double ohm) const noexcept {
    // A reading belongs to a check pulse or to the last train, and |Z| depends on the pulse.
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

}  // namespace tacto
