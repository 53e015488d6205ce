// DeviceThread.h - runs one device's step code on a thread of its own (steady clock only).
//
// The step returns when it wants to run again; wake() makes it run at once. On the virtual clock the bench
// calls the same steps itself and no DeviceThread exists.
//
// Thread-safety: wake() any thread. Construction and destruction (which joins) from one thread.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "core/base/Clock.h"

namespace tacto {

class DeviceThread {
public:
    /// `step` gets the time and returns its next due time. It must not throw.
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
    std::thread thread_;     // Last: starts when all else is ready
};

}  // namespace tacto
