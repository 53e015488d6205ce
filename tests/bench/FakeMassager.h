// FakeMassager.h - a massager that records what it was sent, and when.
//
// Thread-safety: as a Massager; sent(), `offs` and `unplugged` from any thread; set `onVibrate` before use.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <vector>

#include "core/base/Clock.h"
#include "core/devices/Stimulator.h"

namespace tacto::test {

/// Records its commands. Bursts end by themselves.
class FakeMassager final : public Massager {
public:
    explicit FakeMassager(const Clock& clock)
        : FakeMassager(clock, {"fake:massager", Role::Massager, "fake massager", "M1", "", true}) {}
    FakeMassager(const Clock& clock, DeviceIdentity identity) : identity_(std::move(identity)), clock_(clock) {}
    struct Sent {
        Instant at;
        VibrationBurst burst;
    };
    const DeviceIdentity& identity() const noexcept override { return identity_; }
    Result<void> vibrate(ApprovedBurst&& burst) override {
        if (unplugged) return fail(ErrorCode::Device, "the massager was unplugged");
        const std::scoped_lock lock(mutex_);
        sent_.push_back({clock_.now(), burst.burst()});
        if (onVibrate) onVibrate();
        return {};
    }
    [[nodiscard]] double step() const noexcept override { return 0; }
    void forceOff() noexcept override { ++offs; }
    [[nodiscard]] std::vector<Sent> sent() const {
        const std::scoped_lock lock(mutex_);
        return sent_;
    }

    std::atomic<int> offs{0};
    std::atomic<bool> unplugged{false};
    std::function<void()> onVibrate;

private:
    const DeviceIdentity identity_;
    const Clock& clock_;
    mutable std::mutex mutex_;
    std::vector<Sent> sent_;
};

}  // namespace tacto::test
