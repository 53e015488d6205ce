// TaskThread.h - a thread that carries out tasks in the order in which they were posted, and something of its own
// between them.
//
// Thread-safety: post() any thread; the rest its owner.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace tacto::gui {

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

}  // namespace tacto::gui
