#include "core/exchange/SlotFinder.h"

#include <algorithm>
#include <cmath>

namespace tacto {

namespace {
constexpr double kMaxSlots = 9e15;  // a double counts so far
}

std::optional<SlotFinder::Place> SlotFinder::next(double t_s) {
    const double at = t_s * slotRate_hz_ + 0.5;
    if (!(at >= 0 && at < kMaxSlots && at >= static_cast<double>(last_))) {
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

std::size_t SlotFinder::follow(std::span<const double> t_s) {
    if (last_ < 0) return 0;
    // Copies, which stay in the processor's registers.
    const double rate_hz = slotRate_hz_;
    double slot = static_cast<double>(last_), worst_s = counts_.maxTimeError_s, error_s = lastError_s_;
    std::size_t taken = 0;
    for (; taken < t_s.size(); ++taken) {
        const double at = t_s[taken] * rate_hz + 0.5;
        if (!(at >= slot + 1 && at < slot + 2 && at < kMaxSlots)) break;
        ++slot;
        worst_s = std::max(worst_s, error_s);
        error_s = std::abs(t_s[taken] - slot / rate_hz);
    }
    if (taken == 0) return 0;
    last_ = static_cast<std::int64_t>(slot);
    last_s_ = t_s[taken - 1];
    counts_.maxTimeError_s = worst_s;
    lastError_s_ = error_s;
    return taken;
}

GridCounts SlotFinder::counts() const {
    auto counts = counts_;
    counts.maxTimeError_s = std::max(counts.maxTimeError_s, lastError_s_);
    return counts;
}

}  // namespace tacto
