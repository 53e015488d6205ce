#include "app/gui/window/ExposureNow.h"

#include <algorithm>
#include <cmath>

namespace tacto::gui {

bool outputIsOff(InterlockState state) {
    return state == InterlockState::Disconnected || state == InterlockState::Disarmed ||
           state == InterlockState::Faulted;
}

std::vector<ExposureRow> exposureNow(const Telemetry& telemetry) {
    const auto booked = telemetry.exposure();
    std::vector<ExposureRow> rows(booked.begin(), booked.end());
    if (!outputIsOff(telemetry.state)) return rows;
    if (std::ranges::all_of(rows, [](const ExposureRow& row) { return std::isnan(row.limit); })) return {};
    for (auto& row : rows) {
        if (!row.evaluated || std::isnan(row.value) || windowOf(row.quantity) > 0) continue;
        row.value = 0;
        row.within = true;
        row.measured = std::nan("");
        row.beyond = false;
    }
    return rows;
}

}  // namespace tacto::gui
