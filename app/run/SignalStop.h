// SignalStop.h - turns Ctrl+C, Ctrl+\, termination and closing of the terminal into a stop of the run. A thread waits
// for the signal, so that the restrictions of signal handlers do not apply to the bench.
//
// Thread-safety: make one before any other thread starts, so that all threads inherit the blocked signals.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

namespace tacto {

class SignalStop {
public:
    SignalStop();
    ~SignalStop();
    SignalStop(const SignalStop&) = delete;
    SignalStop& operator=(const SignalStop&) = delete;

    /// Called on the waiting thread at each SIGINT, SIGTERM, SIGHUP or SIGQUIT. An empty function calls nothing.
    void onStop(std::function<void()> stop);
    [[nodiscard]] bool signalled() const noexcept { return signalled_; }

private:
    void wait();
    std::mutex mutex_;
    std::function<void()> stop_;  // guarded by mutex_
    std::atomic<bool> signalled_{false};
    std::atomic<bool> quitting_{false};
    std::thread thread_;  // declared last: starts when everything else is ready
};

}  // namespace tacto
