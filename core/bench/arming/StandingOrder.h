// StandingOrder.h - the operator's order under which a bench works, and how waiting calls learn of its end: a stop ends
// the order for good, a pause delays it.
//
// Thread-safety: any thread.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string_view>

#include "core/base/Units.h"
#include "core/safety/FixedText.h"
#include "core/safety/StopCounter.h"

namespace tacto {

class StandingOrder {
public:
    /// Holds the first order, given at `asked`, a mark of `stops`. Without `stops` the bench counts its own: from now.
    StandingOrder(const std::shared_ptr<StopCounter>& stops, StopMark asked)
        : stops_(stops ? stops : std::make_shared<StopCounter>()), asked_(stops ? asked : stops_->mark()) {}

    [[nodiscard]] StopCounter& stops() noexcept { return *stops_; }
    /// When the operator gave the order.
    [[nodiscard]] StopMark asked() const noexcept { return asked_.load(std::memory_order_acquire); }
    /// True if a stop has come since the order.
    [[nodiscard]] bool stopped() const noexcept { return stops_->movedSince(asked()); }
    /// Replaces the order.
    void begin(StopMark asked) noexcept { asked_.store(asked, std::memory_order_release); }

    void pause() noexcept { paused_.store(true, std::memory_order_release); }
    void resume() noexcept {
        {
            const std::scoped_lock lock(mutex_);
            paused_.store(false, std::memory_order_release);
        }
        changed_.notify_all();
    }
    /// Wakes waiting calls after a stop: they check their condition at once.
    void wakeWaiting() noexcept {
        { const std::scoped_lock lock(mutex_); }
        changed_.notify_all();
    }

    /// Returns once there is no pause, or a stop has come.
    void waitWhilePaused() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return !paused_ || stopped(); });
    }
    /// Returns after `longest`, or as soon as a stop has come.
    void waitForStop(Instant longest) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, longest, [this] { return stopped(); });
    }

private:
    const std::shared_ptr<StopCounter> stops_;
    std::atomic<StopMark> asked_;
    std::atomic<bool> paused_{false};
    std::mutex mutex_;
    std::condition_variable changed_;  // notified of a stop, a pause or its end
};

// The operator's order that the control loop carries out: whether it was stopped, whether its owner still looks after
// it, and why the loop itself ended it. attend(), begin() and endedBecause() any thread; the rest has one caller, the
// loop.

class OwnerWatchdog {
public:
    /// `stops` outlives this; if null, only the interlock stops an order.
    explicit OwnerWatchdog(StopCounter* stops) noexcept : stops_(stops) {}

    /// Confirms that the owner of the output looks after it until `until`.
    void attend(Instant until) noexcept { attendedUntil_.store(until.count(), std::memory_order_release); }
    [[nodiscard]] bool attended(Instant now) const noexcept {
        return now.count() <= attendedUntil_.load(std::memory_order_acquire);
    }

    /// Starts an order that the loop has not ended.
    void begin() noexcept {
        const std::scoped_lock lock(mutex_);
        endedBecause_ = {};
    }
    /// Ends the order as a stop does.
    void end(std::string_view why) noexcept {
        {
            const std::scoped_lock lock(mutex_);
            endedBecause_ = why;
        }
        if (stops_ != nullptr) stops_->raise();
    }
    /// Empty if the loop did not end the order.
    [[nodiscard]] FixedText<159> endedBecause() const noexcept {
        const std::scoped_lock lock(mutex_);
        return endedBecause_;
    }

    /// Notes that the output is armed for the order given at `asked`.
    void armFor(StopMark asked) noexcept { armedFor_ = asked; }
    /// True if a stop has come since that order.
    [[nodiscard]] bool stopped() const noexcept { return stops_ != nullptr && stops_->movedSince(armedFor_); }

private:
    StopCounter* const stops_;
    std::atomic<Instant::rep> attendedUntil_{0};
    mutable std::mutex mutex_;
    FixedText<159> endedBecause_;  // guarded by mutex_
    StopMark armedFor_;            // used by the loop only
};

}  // namespace tacto
