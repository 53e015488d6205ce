// OwnerWatchdog.h - the operator's order that the control loop carries out: whether it was stopped, whether its owner
// still looks after it, and why the loop itself ended it.
//
// Thread-safety: attend(), begin() and endedBecause() any thread; the rest has one caller, the control loop.
#pragma once

#include <atomic>
#include <mutex>
#include <string_view>

#include "core/base/Units.h"
#include "core/safety/FixedText.h"
#include "core/safety/StopCounter.h"

namespace tacto {

class OwnerWatchdog {
public:
    /// `stops` outlives this; null: nothing stops an order but the interlock.
    explicit OwnerWatchdog(StopCounter* stops) noexcept : stops_(stops) {}

    /// Who ordered the output is looking after it until then.
    void attend(Instant until) noexcept { attendedUntil_.store(until.count(), std::memory_order_release); }
    [[nodiscard]] bool attended(Instant now) const noexcept {
        return now.count() <= attendedUntil_.load(std::memory_order_acquire);
    }

    /// What comes from now on is an order that the loop has not ended.
    void begin() noexcept {
        const std::scoped_lock lock(mutex_);
        endedBecause_ = {};
    }
    /// Every order from before is over, as by a stop.
    void end(std::string_view why) noexcept {
        {
            const std::scoped_lock lock(mutex_);
            endedBecause_ = why;
        }
        if (stops_ != nullptr) stops_->raise();
    }
    /// Empty where the loop did not end it.
    [[nodiscard]] FixedText<159> endedBecause() const noexcept {
        const std::scoped_lock lock(mutex_);
        return endedBecause_;
    }

    /// The output is armed for the order that was given at `asked`.
    void armFor(StopMark asked) noexcept { armedFor_ = asked; }
    /// A stop has come since that order was given.
    [[nodiscard]] bool stopped() const noexcept { return stops_ != nullptr && stops_->movedSince(armedFor_); }

private:
    StopCounter* const stops_;
    std::atomic<Instant::rep> attendedUntil_{0};
    mutable std::mutex mutex_;
    FixedText<159> endedBecause_;  // guarded by mutex_
    StopMark armedFor_;            // the loop's own
};

}  // namespace tacto
