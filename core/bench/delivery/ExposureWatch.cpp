#include "core/bench/delivery/ExposureWatch.h"

#include <algorithm>

namespace tacto {

void ExposureWatch::look(Instant now, const MeasuredOutput& measured) noexcept {
    constexpr Instant kEvery = std::chrono::milliseconds(100);
    const bool isAnother = anotherOrder_.exchange(false, std::memory_order_acq_rel);
    if (!isAnother && now - at_ < kEvery && at_ != Instant(0)) return;
    at_ = now;
    gate_.exposure(rows_);
    for (auto& row : rows_) {
        if (row.quantity != Quantity::CommandVoltage) continue;
        row.measured = measured.volts;
        row.beyond = measured.beyond;
    }
    now_.count = std::min(rows_.size(), now_.rows.size());
    std::copy_n(rows_.begin(), now_.count, now_.rows.begin());
    latestNow_.write(now_);
    if (isAnother) worst_ = {};
    worst_.take(rows_);
    latestWorst_.write(worst_);
}

void ExposureWatch::show(Telemetry& all) const noexcept {
    const auto table = latestNow_.read();
    all.exposureRows = table.rows;
    all.exposureCount = table.count;
}

}  // namespace tacto
