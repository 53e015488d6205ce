// DeviceFeed.h - runs an emulated device in real time: its own thread sends what is due, as a device's own clock would.
// The creator carries the bytes, through an emulated USB node or a pseudo-terminal.
//
// Thread-safety: any thread.
#pragma once

#include <algorithm>
#include <array>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <thread>

#include "core/base/Clock.h"

namespace tacto::test {

template <class Device>
class DeviceFeed {
public:
    using Send = std::function<void(std::span<const std::uint8_t>)>;
    using PowerUp = std::function<std::unique_ptr<Device>(Instant)>;

    /// The thread calls `send` without a lock. It asks the device for bytes again after `rest` at the earliest.
    DeviceFeed(const Clock& clock, Send send, PowerUp powerUp, Instant rest = Instant(0))
        : clock_(clock),
          send_(std::move(send)),
          powerUp_(std::move(powerUp)),
          rest_(rest),
          device_(powerUp_(clock.now())),
          thread_([this] { run(); }) {}
    ~DeviceFeed() { stop(); }
    DeviceFeed(const DeviceFeed&) = delete;
    DeviceFeed& operator=(const DeviceFeed&) = delete;

    /// Passes bytes from the host to the device.
    void receive(std::span<const std::uint8_t> bytes) {
        change([&] {
            if (powered_) device_->receive(bytes, clock_.now());
        });
    }
    /// Without power the device sends nothing; when power returns, it restarts.
    void power(bool on) {
        change([&] {
            if (on && !powered_) device_ = powerUp_(clock_.now());
            powered_ = on;
        });
    }
    /// Ends sending, for an owner that destroys what `send` uses first. May be called again.
    void stop() {
        change([this] { quitting_ = true; });
        if (thread_.joinable()) thread_.join();
    }

    /// Calls `look(device, now)` while no other thread can use the device.
    template <class Look>
    auto inspect(Look&& look) {
        const std::scoped_lock lock(mutex_);
        return look(*device_, clock_.now());
    }

private:
    template <class Change>
    void change(Change&& what) {
        {
            const std::scoped_lock lock(mutex_);
            what();
        }
        changed_.notify_all();
    }

    void run() {
        std::array<std::uint8_t, 1024> bytes{};
        std::unique_lock lock(mutex_);
        while (!quitting_) {
            if (const auto size = powered_ ? device_->transmit(bytes, clock_.now()) : 0; size > 0) {
                lock.unlock();
                send_(std::span<const std::uint8_t>(bytes).first(size));
                lock.lock();
                continue;
            }
            if (const auto due = powered_ ? device_->nextTransmit() : std::nullopt)
                changed_.wait_for(lock, std::max(*due - clock_.now(), rest_));
            else
                changed_.wait(lock);
        }
    }

    const Clock& clock_;
    const Send send_;
    const PowerUp powerUp_;
    const Instant rest_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::unique_ptr<Device> device_;  // guarded by mutex_
    bool powered_ = true;             // guarded by mutex_
    bool quitting_ = false;           // guarded by mutex_
    std::thread thread_;              // declared last: starts when everything else is ready
};

}  // namespace tacto::test
