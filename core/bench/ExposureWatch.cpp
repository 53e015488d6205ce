#include "core/bench/ExposureWatch.h"

#include <algorithm>

namespace tacto {

void ExposureWatch::look(Instant now, Telemetry& shown) noexcept {
    constexpr Instant kEvery = std::chrono::milliseconds(100);
    const bool isAnother = anotherOrder_.exchange(false, std::memory_order_acq_rel);
    if (!isAnother && now - at_ < kEvery && at_ != Instant(0)) return;
    at_ = now;
    gate_.exposure(rows_);
    shown.exposureCount = std::min(rows_.size(), shown.exposureRows.size());
    std::copy_n(rows_.begin(), shown.exposureCount, shown.exposureRows.begin());
    if (isAnother) worst_ = {};
    worst_.take(rows_);
    latestWorst_.write(worst_);
}

}  // namespace tacto
