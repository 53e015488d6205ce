#include "core/exchange/SlotFinder.h"

#include <algorithm>
#include <cmath>

namespace tacto {

std::optional<SlotFinder::Place> SlotFinder::next(double t_s) {
    const double at = t_s * slotRate_hz_ + 0.5;
    if (!(at >= 0 && at < 9e15 && at >= static_cast<double>(last_))) {
        ++counts_.dropped;
        return std::nullopt;
    }
    const auto slot = static_cast<std::int64_t>(at);
    const bool slipped = slot == last_ + 2 && t_s - last_s_ < slip_s_;
    if (slot == last_)
        ++counts_.dropped;  // the sample before
    else
        counts_.maxTimeError_s = std::max(counts_.maxTimeError_s, lastError_s_);
    if (slipped) ++counts_.repeated;
    lastError_s_ = std::abs(t_s - static_cast<double>(slot) / slotRate_hz_);
    last_ = slot;
    last_s_ = t_s;
    return Place{static_cast<std::uint64_t>(slot), slipped};
}

GridCounts SlotFinder::counts() const {
    auto counts = counts_;
    counts.maxTimeError_s = std::max(counts.maxTimeError_s, lastError_s_);
    return counts;
}

}  // namespace tacto
