// CutTime.h - when the output of a simulated device was switched off; of several requests, the earliest counts.
//
// Thread-safety: any thread; lock-free, so that forceOff() never waits.
#pragma once

#include <atomic>

#include "core/base/Units.h"

namespace tacto::sim {

class CutTime {
public:
    static constexpr Instant kNever = Instant::max();

    void cut(Instant at) noexcept {
        Instant::rep known = at_.load(std::memory_order_acquire);
        while (at.count() < known &&
               !at_.compare_exchange_weak(known, at.count(), std::memory_order_acq_rel, std::memory_order_acquire)) {
        }
    }
    /// Forgets the cut: trains from now on are not cut.
    void forget() noexcept { at_.store(kNever.count(), std::memory_order_release); }
    [[nodiscard]] Instant at() const noexcept { return Instant(at_.load(std::memory_order_acquire)); }

private:
    std::atomic<Instant::rep> at_{kNever.count()};
};

}  // namespace tacto::sim
