#include <algorithm>
#include <cmath>

#include "core/electrode/LoadResponse.h"
#include "core/safety/GateChecks.h"
#include "core/safety/GateState.h"

namespace tacto {

using namespace gate;

/// What is left of the residual voltage by `now`, on the load that keeps it longest. It is not known since when another
/// source is connected: what one left that rests in high impedance may have stayed so until now.
double SafetyGate::State::carriedAt(Instant now) const noexcept {
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

Result<void> SafetyGate::State::withinCalibration(const TrainRequest& request) const {
    const auto& known = setup->calibration;
    if (!checks(PersonBeyondCalibration) || !known || !known->complete()) return {};  // configure() demands them
    constexpr double kSlack = 1 + kLargestMiscalibration;
    const auto beyond = [](std::string_view what, double told, std::string_view unit, double end) {
        return fail(ErrorCode::LimitExceeded,
                    "{} {:.4g} {} is beyond the range in which the stimulator was calibrated, which ends at {:.4g} {}",
                    what, told, unit, end, unit);
    };
    const double level = std::visit([](auto amplitude) { return amplitude.value(); }, request.train.amplitude);
    if (!(level <= known->amplitude.highest * kSlack))
        return beyond("amplitude", level, "mA", known->amplitude.highest);
    const double width = Seconds(request.train.phaseWidth).count();
    if (!(width <= known->phaseWidth->highest * kSlack))
        return beyond("phase width", width * 1e6, "us", known->phaseWidth->highest * 1e6);
    const double interval = request.interval.count();
    if (!(interval >= known->interval->lowest / kSlack))
        return beyond("interval", interval, "s", known->interval->lowest);
    return {};
}

Result<void> SafetyGate::State::judge(const Judged& request) const {
    for (const ActiveLimit& limit : limits) {
        const LimitRow& row = limit.row;
        if (row.action != LimitAction::Refuse || !request.fallsUnder(row)) continue;
        if (needsArea(row.quantity) && std::isnan(area)) continue;  // Reads "not evaluated"
        if (!checks(limitCheck(limit.ceiling ? RequestCeiling : RequestLimit, row.quantity))) continue;
        const bool into500 = row.judged == JudgedAt::Ohm500;
        const double value = (into500 ? request.at500 : request.overRange).at(row.quantity);
        if (keepsLimit(row, value, commandIsComputed())) continue;
        std::string aside;
        if (into500) {
            aside = " into 500 ohm";
        } else if (row.quantity != Quantity::CommandVoltage) {  // which is the same in any case
            const Load& usual = person() ? load.nominal : setup->load.nominal;
            const auto there =
                exposureOf(request.command, request.interval, usual, setup->source, area, {request.carried_V});
            aside = fmt::format(" in the worst case ({:.4g} {} into {})", there.at(row.quantity), unitOf(row.quantity),
                                usual.text());
        }
        return fail(ErrorCode::LimitExceeded, "{}", refusalText(limit, value, aside));
    }
    return {};
}

Result<void> SafetyGate::State::judgeMetered(const Judged& request, Instant now) const {
    auto second = meter.couldShare(Seconds(1), now, request.stretch);
    auto five = meter.couldShare(Seconds(5), now, request.stretch);
    second.overRange += request.overRange.in1s;
    second.at500 += request.at500.in1s;
    five.overRange += request.overRange.in5s;
    five.at500 += request.at500.in5s;
    for (const ActiveLimit& limit : limits) {
        const LimitRow& row = limit.row;
        if (row.action != LimitAction::Refuse || windowOf(row.quantity) == 0) continue;
        const auto& sums = windowOf(row.quantity) == 1 ? second : five;
        // Trains of different rates share the window: every band that one of them belongs to holds.
        if (!request.fallsUnder(row) && !row.holdsAt(sums.lowestHz)) continue;
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

Load SafetyGate::State::measuredLoad(Ohms magnitude) const noexcept {
    const Load& declared = setup->load.nominal;
    DriveSegment leading = segmentsOf(lastTrain, setup->source.gap).items[0];
    if (leading.start == 0) leading = segmentsOf(check, setup->source.gap).items[0];
    const double ratio = magnitude.value() / effectiveImpedance(declared, leading).value();
    return LoadRange::around(declared, ratio, ratio).min;
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
