// BenchTime.h - how time passes on a bench. On the virtual clock, time moves only in here, on the caller's thread,
// which serves the devices and steps the control loop in order of time. On the steady clock, the loop and each device
// have their own threads, and the caller waits. The step code is the same.
//
// Thread-safety: wakeOutput() any thread; the rest has one caller, the bench's.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "core/base/Clock.h"
#include "core/bench/ControlLoop.h"
#include "core/bench/arming/StandingOrder.h"
#include "core/bench/delivery/BenchOutput.h"
#include "core/bench/sensing/ScopeSession.h"
#include "core/bench/sensing/SensorSession.h"

namespace tacto {

// Runs the step code of one device on its own thread (steady clock only).
//
// The step returns the time of its next run; wake() makes it run at once. On the virtual clock the bench calls the same
// steps itself, and no DeviceThread exists.

class DeviceThread {
public:
    /// `step` receives the time and returns the time of its next call. It must not throw.
    DeviceThread(const Clock& clock, std::function<Instant(Instant)> step);
    ~DeviceThread();
    DeviceThread(const DeviceThread&) = delete;
    DeviceThread& operator=(const DeviceThread&) = delete;

    void wake() noexcept;

private:
    void run();

    const Clock& clock_;
    const std::function<Instant(Instant)> step_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool woken_ = false;     // guarded by mutex_
    bool quitting_ = false;  // guarded by mutex_
    std::thread thread_;     // last, because it starts when all else is ready
};

class BenchTime {
public:
    /// All arguments outlive this object.
    BenchTime(Clock& clock, BenchOutput& output, StandingOrder& order) noexcept
        : clock_(clock), virtual_(dynamic_cast<VirtualClock*>(&clock)), output_(output), order_(order) {}

    [[nodiscard]] bool isVirtual() const noexcept { return virtual_ != nullptr; }
    [[nodiscard]] Instant now() const noexcept { return clock_.now(); }
    /// Sets the callback that advance() calls each time it checks its conditions.
    void onProgress(void (*callback)(void* context), void* context) noexcept;

    /// Starts time for these parts. All outlive this object; all but the loop may be null. advance() calls `watch`
    /// first at each check; an error from `watch` ends the wait.
    void start(ControlLoop& loop, SensorSession* sensor, ScopeSession* scope, SessionRecorder* recorder,
               std::function<Result<void>()> watch);
    /// After this returns, the loop takes no further step.
    void endLoop() noexcept { loopThread_.reset(); }
    /// After this returns, no device is served any longer. End the loop first.
    void endDevices() noexcept;

    /// Lets time pass until `done` returns true or `until` is reached; returns whether `done` did. A pause holds up the
    /// virtual clock. Errors: as `watch`.
    [[nodiscard]] Result<bool> advance(Instant until, const std::function<bool()>& done);
    /// Lets one turn pass (steady clock: up to `longest`), at most to `until`, in any state of the order.
    void pass(Instant until, Instant longest) noexcept;
    /// Until `until` or a stop, the loop takes no step, as if it hung; the devices continue.
    void withholdLoop(Instant until);
    /// Serves the output or the sensor once, out of turn; on the steady clock the device's thread does so within 1 ms.
    void prompt(Role role) noexcept;
    /// Tells the output's thread that the output has something to do at once.
    void wakeOutput() noexcept {
        if (outputThread_) outputThread_->wake();
    }

private:
    void turn(Instant until) noexcept;
    void startThreads();

    Clock& clock_;
    VirtualClock* const virtual_;  // null if the clock is steady
    BenchOutput& output_;
    StandingOrder& order_;
    ControlLoop* loop_ = nullptr;
    SensorSession* sensor_ = nullptr;
    ScopeSession* scope_ = nullptr;
    SessionRecorder* recorder_ = nullptr;
    std::function<Result<void>()> watch_;
    void (*progress_)(void*) = nullptr;
    void* progressContext_ = nullptr;

    // Virtual clock only:
    Instant nextTick_{0};
    Instant outputDue_{0};

    // Steady clock only. Declared last, so that the threads end first.
    std::atomic<bool> withheld_{false};  // while true, the loop's thread does nothing
    std::unique_ptr<DeviceThread> outputThread_, sensorThread_, scopeThread_, loopThread_;
};

}  // namespace tacto
