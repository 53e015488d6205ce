// TaskThread.h - the bench's thread, and a watch on whether the window's thread still runs.
//
// Thread-safety: post() and runs() any thread; the rest their owner.
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

/// A thread that carries out tasks in the order in which they were posted, and something of its own between them.
class TaskThread {
public:
    /// Carries out `turn` after each task, and every few milliseconds as long as it returns true; `end` at the end.
    TaskThread(std::function<bool()> turn, std::function<void()> end);
    ~TaskThread() { quit(); }
    TaskThread(const TaskThread&) = delete;
    TaskThread& operator=(const TaskThread&) = delete;

    void post(std::function<void()> task);
    /// Waits for the task at work; those behind it are dropped.
    void quit();

private:
    void work(const std::function<bool()>& turn);

    std::mutex mutex_;
    std::condition_variable came_;
    std::deque<std::function<void()>> tasks_;  // guarded by mutex_
    bool quitting_ = false;                    // guarded by mutex_
    std::thread thread_;                       // last: starts when all else is ready
};

/// Watches whether the window's thread still runs: a window that hangs shows no STOP and hears no Esc, so that the
/// output is then unattended (hazard H2).
class WindowHeartbeat final : public QObject {
    Q_OBJECT
public:
    static constexpr std::chrono::milliseconds kBeat{100};
    static constexpr std::chrono::milliseconds kHangs{1000};  ///< without a beat for that long
    WindowHeartbeat();
    [[nodiscard]] bool runs() const noexcept;

private:
    using Time = std::chrono::steady_clock;
    void beat() noexcept { seen_.store(Time::now().time_since_epoch().count(), std::memory_order_release); }
    QTimer timer_;
    std::atomic<Time::rep> seen_{0};
};

}  // namespace tacto::gui
