#include "core/bench/BenchTime.h"

#include <algorithm>
#include <thread>
#include <utility>

namespace tacto {

void BenchTime::onProgress(void (*callback)(void* context), void* context) noexcept {
    progress_ = callback;
    progressContext_ = context;
}

void BenchTime::start(ControlLoop& loop, SensorSession* sensor, ScopeSession* scope, SessionRecorder* recorder,
                      std::function<Result<void>()> watch) {
    loop_ = &loop;
    sensor_ = sensor;
    scope_ = scope;
    recorder_ = recorder;
    watch_ = std::move(watch);
    nextTick_ = outputDue_ = clock_.now();
    if (!isVirtual()) startThreads();
}

void BenchTime::startThreads() {
    if (output_.isOpen())
        outputThread_ = std::make_unique<DeviceThread>(clock_, [this](Instant now) { return output_.serve(now); });
    if (sensor_ != nullptr)
        sensorThread_ = std::make_unique<DeviceThread>(clock_, [this](Instant now) { return sensor_->serve(now); });
    if (scope_ != nullptr)
        scopeThread_ = std::make_unique<DeviceThread>(clock_, [this](Instant now) { return scope_->serve(now); });
    loopThread_ = std::make_unique<DeviceThread>(clock_, [this, due = clock_.now()](Instant now) mutable {
        if (withheld_.load(std::memory_order_acquire)) return now + ControlLoop::kPeriod;
        loop_->step(now);
        // After a delay of more than a step, continue from now instead of making the missed steps in a burst.
        due = std::max(due + ControlLoop::kPeriod, now);
        return due;
    });
}

void BenchTime::endDevices() noexcept {
    scopeThread_.reset();
    sensorThread_.reset();
    outputThread_.reset();
}

/// On the virtual clock, moves time to the next event, at most to `until`, and handles that event.
void BenchTime::turn(Instant until) noexcept {
    const Instant next = std::min(until, output_.isOpen() ? std::min(nextTick_, outputDue_) : nextTick_);
    virtual_->advanceTo(next);
    const Instant now = virtual_->now();
    if (output_.isOpen() && now >= outputDue_) outputDue_ = output_.serve(now);
    if (now < nextTick_) return;
    nextTick_ = now + ControlLoop::kPeriod;
    if (sensor_ != nullptr) sensor_->serve(now);
    loop_->step(now);
    if (output_.busy()) outputDue_ = output_.serve(now);
    if (scope_ != nullptr && scope_->active()) scope_->serve(now);
    if (recorder_ != nullptr) recorder_->writeMarks();
}

Result<bool> BenchTime::advance(Instant until, const std::function<bool()>& done) {
    constexpr Instant kPollInterval = std::chrono::milliseconds(2);
    for (std::uint64_t turns = 0;; ++turns) {
        if (const auto well = watch_(); !well) return failure(well);
        if (done()) return true;
        if (clock_.now() >= until) return false;
        if (progress_ != nullptr && turns % 64 == 0) progress_(progressContext_);
        if (isVirtual()) {
            order_.waitWhilePaused();
            turn(until);
        } else {
            order_.waitForStop(std::min(kPollInterval, until - clock_.now()));
        }
    }
}

void BenchTime::pass(Instant until, Instant longest) noexcept {
    if (isVirtual())
        turn(until);
    else
        std::this_thread::sleep_for(std::min(longest, until - clock_.now()));
}

void BenchTime::withholdLoop(Instant until) {
    if (isVirtual()) {
        while (!order_.stopped() && clock_.now() < until) {
            // Serves only the devices, as their own threads would do while the loop hangs.
            virtual_->advanceTo(output_.isOpen() ? std::min(until, outputDue_) : until);
            const Instant now = clock_.now();
            if (output_.isOpen() && now >= outputDue_) outputDue_ = output_.serve(now);
            if (scope_ != nullptr && scope_->active()) scope_->serve(now);
        }
        nextTick_ = clock_.now();
    } else {
        withheld_.store(true, std::memory_order_release);
        order_.waitForStop(until - clock_.now());
        withheld_.store(false, std::memory_order_release);
    }
}

void BenchTime::prompt(Role role) noexcept {
    const bool sensor = role == Role::Sensor;
    if (isVirtual()) {
        static_cast<void>(sensor ? sensor_->serve(clock_.now()) : output_.serve(clock_.now()));
        return;
    }
    (sensor ? sensorThread_ : outputThread_)->wake();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

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
