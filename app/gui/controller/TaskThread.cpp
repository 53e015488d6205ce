#include "app/gui/controller/TaskThread.h"

#include <chrono>
#include <utility>

namespace tacto::gui {

TaskThread::TaskThread(std::function<bool()> turn, std::function<void()> end)
    : thread_([this, turn = std::move(turn), end = std::move(end)] {
          work(turn);
          end();
      }) {}

void TaskThread::post(std::function<void()> task) {
    {
        const std::scoped_lock lock(mutex_);
        tasks_.push_back(std::move(task));
    }
    came_.notify_all();
}

void TaskThread::quit() {
    {
        const std::scoped_lock lock(mutex_);
        quitting_ = true;
    }
    came_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void TaskThread::work(const std::function<bool()>& turn) {
    constexpr auto kTurn = std::chrono::milliseconds(4);
    bool busy = false;
    for (;;) {
        std::function<void()> task;
        {
            std::unique_lock lock(mutex_);
            const auto wanted = [this] { return quitting_ || !tasks_.empty(); };
            if (busy)
                came_.wait_for(lock, kTurn, wanted);
            else
                came_.wait(lock, wanted);
            if (quitting_) return;
            if (!tasks_.empty()) {
                task = std::move(tasks_.front());
                tasks_.pop_front();
            }
        }
        if (task) task();
        busy = turn();
    }
}

WindowHeartbeat::WindowHeartbeat() {
    beat();
    connect(&timer_, &QTimer::timeout, this, &WindowHeartbeat::beat);
    timer_.start(kBeat);
}

bool WindowHeartbeat::runs() const noexcept {
    const Time::time_point seen{Time::duration(seen_.load(std::memory_order_acquire))};
    return Time::now() - seen < kHangs;
}

}  // namespace tacto::gui

#include "moc_TaskThread.cpp"
