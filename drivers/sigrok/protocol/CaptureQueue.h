// CaptureQueue.h - a queue that an instrument's thread fills and the bench's thread polls.
//
// Holds what the two threads tell each other: captures, errors, the arming in force, and when the session's loop last
// ran. Shared, so that the queue stays alive if the instrument's thread never ends.
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

    /// Begins a new arming, drops captures of earlier ones and returns the new arming's number, which is never 0.
    std::uint64_t arm();
    void disarm() noexcept { armed_ = 0; }
    [[nodiscard]] bool armed() const noexcept { return armed_ != 0; }
    /// True if arming `number` is still in force. Also notes that the loop runs.
    [[nodiscard]] bool wanted(std::uint64_t number) noexcept;

    /// Notes that the instrument now waits for triggers.
    void started(std::uint64_t number);
    /// Waits for started(). Returns false after fail() or if started() was not called within `timeout`.
    [[nodiscard]] bool waitStarted(std::uint64_t number, Seconds timeout);

    /// Waits while kHeld captures are queued and `number` is in force. Returns false once `number` is not in force.
    [[nodiscard]] bool waitForRoom(std::uint64_t number);
    [[nodiscard]] bool hasRoom() const;
    /// Adds `capture`, or drops it if `number` is no longer in force.
    void push(std::uint64_t number, Capture capture);
    /// Stores a final error: the first error stays.
    void fail(Error error);

    [[nodiscard]] std::optional<Error> error() const;
    [[nodiscard]] std::optional<Capture> pop();
    /// Returns for how long the instrument's thread has not called.
    [[nodiscard]] Seconds sinceTurn() const noexcept;

    /// For ForcedTrigger: force() requests a record without a trigger, takeForced() takes the request.
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
