// SignalStop.h - Ctrl+C, Ctrl+\, termination and a terminal that closes as a stop of the run: a thread waits for the
// signal, so that the handler's restrictions do not reach the bench.
//
// Thread-safety: make one before any other thread starts, so that they all inherit the blocked signals.
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
    std::thread thread_;  // Last: starts when all else is ready
};

}  // namespace tacto
