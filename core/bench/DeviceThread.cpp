#include "core/bench/DeviceThread.h"

namespace tacto {

DeviceThread::DeviceThread(const Clock& clock, std::function<Instant(Instant)> step)
    : clock_(clock), step_(std::move(step)), thread_([this] { run(); }) {}

DeviceThread::~DeviceThread() {
    {
        const std::scoped_lock lock(mutex_);
        quitting_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

void DeviceThread::wake() noexcept {
    {
        const std::scoped_lock lock(mutex_);
        woken_ = true;
    }
    changed_.notify_one();
}

void DeviceThread::run() {
    std::unique_lock lock(mutex_);
    while (!quitting_) {
        woken_ = false;
        lock.unlock();
        const Instant next = step_(clock_.now());
        lock.lock();
        const auto left = next - clock_.now();
        if (left.count() > 0) changed_.wait_for(lock, left, [this] { return woken_ || quitting_; });
    }
}

}  // namespace tacto
