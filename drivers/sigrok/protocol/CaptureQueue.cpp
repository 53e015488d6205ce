#include "drivers/sigrok/protocol/CaptureQueue.h"

#include <utility>

namespace tacto::sigrok_driver {

namespace {
using SteadyTime = std::chrono::steady_clock;
}

std::uint64_t CaptureQueue::arm() {
    const std::scoped_lock lock(mutex_);
    captures_.clear();
    forced_ = false;
    turned_ = SteadyTime::now().time_since_epoch().count();
    armed_ = ++last_;
    changed_.notify_all();
    return last_;
}

bool CaptureQueue::wanted(std::uint64_t number) noexcept {
    turned_ = SteadyTime::now().time_since_epoch().count();
    return armed_ == number;
}

void CaptureQueue::started(std::uint64_t number) {
    const std::scoped_lock lock(mutex_);
    started_ = number;
    changed_.notify_all();
}

bool CaptureQueue::waitStarted(std::uint64_t number, Seconds timeout) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [&] { return started_ == number || error_; });
    return started_ == number && !error_;
}

bool CaptureQueue::waitForRoom(std::uint64_t number) {
    std::unique_lock lock(mutex_);
    while (wanted(number)) {
        if (captures_.size() < kHeld) return true;
        changed_.wait_for(lock, std::chrono::milliseconds(100));  // disarm() must not wait, so it does not notify
    }
    return false;
}

bool CaptureQueue::hasRoom() const {
    const std::scoped_lock lock(mutex_);
    return captures_.size() < kHeld;
}

void CaptureQueue::push(std::uint64_t number, Capture capture) {
    const std::scoped_lock lock(mutex_);
    if (armed_ == number) captures_.push_back(std::move(capture));
}

void CaptureQueue::fail(Error error) {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = std::move(error);
    armed_ = 0;
    changed_.notify_all();
}

std::optional<Error> CaptureQueue::error() const {
    const std::scoped_lock lock(mutex_);
    return error_;
}

std::optional<Capture> CaptureQueue::pop() {
    const std::scoped_lock lock(mutex_);
    if (captures_.empty() || armed_ == 0) return std::nullopt;
    std::optional<Capture> oldest(std::move(captures_.front()));
    captures_.pop_front();
    changed_.notify_all();
    return oldest;
}

Seconds CaptureQueue::sinceTurn() const noexcept {
    return SteadyTime::now().time_since_epoch() - SteadyTime::duration(turned_.load());
}

}  // namespace tacto::sigrok_driver
