// TaskThread.h - the bench's thread, and a watch on whether the window's thread still responds.
//
// Thread-safety: post() and runs() any thread; all else the owner's thread.
#pragma once

#include <QObject>
#include <QTimer>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace tacto::gui {

/// A thread that runs tasks in the order of their posting, and a function of its own between them.
class TaskThread {
public:
    /// Calls `turn` after each task, and every few milliseconds while it returns true; calls `end` at the end.
    TaskThread(std::function<bool()> turn, std::function<void()> end);
    ~TaskThread() { quit(); }
    TaskThread(const TaskThread&) = delete;
    TaskThread& operator=(const TaskThread&) = delete;

    void post(std::function<void()> task);
    /// Waits for the present task; drops all tasks after it.
    void quit();

private:
    void work(const std::function<bool()>& turn);

    std::mutex mutex_;
    std::condition_variable came_;
    std::deque<std::function<void()>> tasks_;  // guarded by mutex_
    bool quitting_ = false;                    // guarded by mutex_
    std::thread thread_;                       // declared last: starts when all else is ready
};

/// Checks whether the window's thread still responds: a window that hangs shows no STOP and does not receive Esc, so
/// that the output is unattended (hazard H2).
class WindowHeartbeat final : public QObject {
    Q_OBJECT
public:
    static constexpr std::chrono::milliseconds kBeat{100};
    static constexpr std::chrono::milliseconds kHangs{1000};  ///< time without a beat after which the window hangs
    WindowHeartbeat();
    [[nodiscard]] bool runs() const noexcept;

private:
    using Time = std::chrono::steady_clock;
    void beat() noexcept { seen_.store(Time::now().time_since_epoch().count(), std::memory_order_release); }
    QTimer timer_;
    std::atomic<Time::rep> seen_{0};
};

}  // namespace tacto::gui
