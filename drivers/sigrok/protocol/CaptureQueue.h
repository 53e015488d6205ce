// CaptureQueue.h - between an instrument's thread, which fills it, and the bench's, which polls.
//
// Holds what both need to know of each other: what was captured, what went wrong, which arming is in force, and when
// the session's loop last turned. Shared: a thread that does not come back keeps it.
//
// Thread-safety: any thread.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/measure/Capture.h"

namespace tacto::sigrok_driver {

class CaptureQueue {
public:
    static constexpr std::size_t kHeld = 64;

    /// Begins a new arming and drops captures of earlier ones; returns its number. 0 is never one.
    std::uint64_t arm();
    void disarm() noexcept { armed_ = 0; }
    [[nodiscard]] bool armed() const noexcept { return armed_ != 0; }
    /// Whether arming `number` is still in force. Also notes that the loop turns.
    [[nodiscard]] bool wanted(std::uint64_t number) noexcept;

    /// The instrument waits for triggers now.
    void started(std::uint64_t number);
    /// Waits for that. False when it has failed or has not come within `timeout`.
    [[nodiscard]] bool waitStarted(std::uint64_t number, Seconds timeout);

    /// Waits while kHeld captures lie here and `number` is in force. False when it no longer is.
    [[nodiscard]] bool waitForRoom(std::uint64_t number);
    [[nodiscard]] bool hasRoom() const;
    /// Dropped when `number` is no longer in force.
    void push(std::uint64_t number, Capture capture);
    /// Final: the first one stays.
    void fail(Error error);

    [[nodiscard]] std::optional<Error> error() const;
    [[nodiscard]] std::optional<Capture> pop();
    /// How long nothing has been heard of the instrument's thread.
    [[nodiscard]] Seconds sinceTurn() const noexcept;

    /// ForcedTrigger: asks for a record without a trigger, and takes the request.
    void force() noexcept { forced_ = true; }
    [[nodiscard]] bool takeForced() noexcept { return forced_.exchange(false); }

private:
    std::atomic<std::uint64_t> armed_{0};
    std::atomic<bool> forced_{false};
    std::atomic<std::chrono::steady_clock::rep> turned_{0};
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::uint64_t started_ = 0;     // guarded by mutex_
    std::uint64_t last_ = 0;        // guarded by mutex_
    std::deque<Capture> captures_;  // guarded by mutex_
    std::optional<Error> error_;    // guarded by mutex_
};

}  // namespace tacto::sigrok_driver
