// EmulatedLine.h - an emulated stimulator at the other end of a Transport, in this process.
//
// On a virtual clock a read that waits moves the clock, so it must be the clock's only mover meanwhile; on a steady one
// it waits. The line outlives its transports: what was put out can be judged after the driver has closed.
//
// Thread-safety: every function from any thread.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>

#include "core/base/Clock.h"
#include "core/devices/Transport.h"
#include "drivers/sciencemode/ScienceModeStimulator.h"
#include "tests/support/emulated/sciencemode/EmulatedStimulator.h"

namespace tacto::test {

class EmulatedLine : public std::enable_shared_from_this<EmulatedLine> {
public:
    using Device = sciencemode::EmulatedStimulator;

    /// `movable` is `clock` itself where it is virtual, else null.
    EmulatedLine(const Clock& clock, VirtualClock* movable, sciencemode::EmulatedSettings settings = {});

    /// A transport to the device. Errors: NotFound while unplugged.
    [[nodiscard]] Result<std::unique_ptr<Transport>> connect();
    [[nodiscard]] Connect connector();

    void unplug();
    /// A device that lost its power while unplugged comes back.
    void plug();
    /// The same socket, another device.
    void plugAnother(sciencemode::EmulatedSettings settings);
    /// Bytes of every write() and writeUrgent() so far.
    [[nodiscard]] std::vector<std::vector<std::uint8_t>> written();
    /// Called in every write(), before its bytes reach the device.
    void onWrite(std::function<void()> hook);

    /// Calls `look(device, now)` while nothing else does.
    template <class Look>
    auto inspect(Look&& look) {
        const std::scoped_lock lock(mutex_);
        hearUrgent();
        return look(*device_, clock_.now());
    }
    [[nodiscard]] std::size_t pulses() {
        return inspect([](Device& device, Instant now) { return device.pulses(now).size(); });
    }
    [[nodiscard]] std::vector<sciencemode::EmittedPulse> pulseList() {
        return inspect([](Device& device, Instant now) {
            const auto& all = device.pulses(now);
            return std::vector<sciencemode::EmittedPulse>(all.begin(), all.end());
        });
    }

private:
    friend class LineTransport;
    void hearUrgent();

    const Clock& clock_;
    VirtualClock* const movable_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::unique_ptr<Device> device_;
    bool plugged_ = true;
    std::uint64_t session_ = 0;  // plug() makes old transports useless
    std::array<std::array<std::uint8_t, Transport::kMaxUrgent>, 4> urgent_{};
    std::array<std::size_t, 4> urgentSize_{};
    std::size_t urgentCount_ = 0;
    std::vector<std::vector<std::uint8_t>> written_;
    std::shared_ptr<const std::function<void()>> hook_;  // shared, so that it keeps what it counts
};

}  // namespace tacto::test
