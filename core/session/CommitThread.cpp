#include "core/session/CommitThread.h"

#include <utility>

namespace tacto {

CommitThread::CommitThread() : thread_([this] { run(); }) {}

CommitThread::~CommitThread() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void CommitThread::start(Job job) {
    {
        const std::lock_guard lock(mutex_);
        job_ = std::move(job);
        busy_.store(true, std::memory_order_release);
    }
    changed_.notify_all();
}

Result<void> CommitThread::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return job_ == nullptr; });
    return std::exchange(result_, Result<void>());
}

void CommitThread::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return ending_ || job_ != nullptr; });
        if (job_ == nullptr) return;  // a waiting job is finished before the thread ends
        const Job job = job_;
        lock.unlock();
        auto result = job();
        lock.lock();
        result_ = std::move(result);
        job_ = nullptr;
        busy_.store(false, std::memory_order_release);
        changed_.notify_all();
    }
}

}  // namespace tacto
