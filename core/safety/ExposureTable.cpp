#include <algorithm>
#include <cmath>
#include <limits>

#include "core/safety/DeliveryBounds.h"
#include "core/safety/GateRules.h"

namespace tacto {

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
    // The command is judged as it is; that a train cannot be judged stays.
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
