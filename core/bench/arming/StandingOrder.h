// StandingOrder.h - the order of the operator for which a bench does everything, and how those who wait for the bench
// learn of its end: a stop ends it for good, a pause holds it up.
//
// Thread-safety: any thread.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>

#include "core/base/Units.h"
#include "core/safety/StopCounter.h"

namespace tacto {

class StandingOrder {
public:
    /// The first order, given at `asked`, a mark of `stops`. Without `stops` the bench has its own, and that is now.
    StandingOrder(const std::shared_ptr<StopCounter>& stops, StopMark asked)
        : stops_(stops ? stops : std::make_shared<StopCounter>()), asked_(stops ? asked : stops_->mark()) {}

    [[nodiscard]] StopCounter& stops() noexcept { return *stops_; }
    /// When the operator gave it.
    [[nodiscard]] StopMark asked() const noexcept { return asked_.load(std::memory_order_acquire); }
    /// A stop has come since.
    [[nodiscard]] bool stopped() const noexcept { return stops_->movedSince(asked()); }
    /// Another order takes its place.
    void begin(StopMark asked) noexcept { asked_.store(asked, std::memory_order_release); }

    void pause() noexcept { paused_.store(true, std::memory_order_release); }
    void resume() noexcept {
        {
            const std::scoped_lock lock(mutex_);
            paused_.store(false, std::memory_order_release);
        }
        changed_.notify_all();
    }
    /// After a stop: a waiting call looks at once.
    void wakeWaiting() noexcept {
        { const std::scoped_lock lock(mutex_); }
        changed_.notify_all();
    }

    /// Returns when there is no pause, or a stop has come.
    void waitWhilePaused() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return !paused_ || stopped(); });
    }
    /// Returns after `longest`, or when a stop has come.
    void waitForStop(Instant longest) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, longest, [this] { return stopped(); });
    }

private:
    const std::shared_ptr<StopCounter> stops_;
    std::atomic<StopMark> asked_;
    std::atomic<bool> paused_{false};
    std::mutex mutex_;
    std::condition_variable changed_;  // a stop, a pause or its end
};

}  // namespace tacto
