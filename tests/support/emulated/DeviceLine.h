// DeviceLine.h - connects an emulated device to a Transport in the same process: the common part of all emulators'
// lines. Derived classes add how their device takes and gives bytes.
//
// On a virtual clock a waiting read advances the clock, so nothing else may advance it meanwhile; on a steady clock the
// read waits. The line outlives its transports, so that the output can be checked after the driver has closed.
//
// Thread-safety: any thread may call the public functions.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Clock.h"
#include "core/devices/TransportPorts.h"

namespace tacto::test {

class DeviceLine : public std::enable_shared_from_this<DeviceLine> {
public:
    using Hook = std::function<void(std::span<const std::uint8_t>)>;

    virtual ~DeviceLine() = default;
    DeviceLine(const DeviceLine&) = delete;
    DeviceLine& operator=(const DeviceLine&) = delete;

    /// Makes a transport to the device. Errors: NotFound while unplugged.
    [[nodiscard]] Result<std::unique_ptr<Transport>> connect();
    [[nodiscard]] Connect connector();
    void unplug();
    /// Transports from before no longer work.
    void plug();
    [[nodiscard]] bool plugged() const;
    /// Returns the bytes of every write() and writeUrgent() so far, one entry per transfer.
    [[nodiscard]] std::vector<std::vector<std::uint8_t>> written();
    /// Sets a hook that every write() calls before its bytes reach the device; empty: no hook.
    void onWrite(Hook hook);

protected:
    /// `movable` is `clock` itself if that is virtual, else null. `name` as in "the emulated NAME is unplugged".
    DeviceLine(const Clock& clock, VirtualClock* movable, std::string name);

    // The device's side, called with mutex_ held.
    [[nodiscard]] virtual Result<void> receive(std::span<const std::uint8_t> bytes, Instant now) = 0;
    virtual void receiveUrgent(std::span<const std::uint8_t> bytes, Instant now) noexcept = 0;
    [[nodiscard]] virtual std::size_t transmit(std::span<std::uint8_t> into, Instant now) = 0;
    /// Returns when the device may have bytes for the host; nothing if only after the next write.
    [[nodiscard]] virtual std::optional<Instant> nextTransmit(Instant now) = 0;
    /// Brings the device up to date with what happened since the last call, before anything else.
    virtual void catchUp(Instant) {}
    virtual void connected() {}
    virtual void powerCycle(Instant) {}

    /// Calls `look(device, now)` while no other thread can use the device.
    template <class Device, class Look>
    auto lookAt(Device& device, Look&& look) {
        const std::scoped_lock lock(mutex_);
        catchUp(clock_.now());
        return look(device, clock_.now());
    }
    void keepWritten(std::span<const std::uint8_t> bytes) { written_.emplace_back(bytes.begin(), bytes.end()); }

    mutable std::mutex mutex_;
    const Clock& clock_;
    std::vector<std::vector<std::uint8_t>> written_;

private:
    friend class LineTransport;

    VirtualClock* const movable_;
    const std::string name_;
    std::condition_variable changed_;
    bool plugged_ = true;
    std::uint64_t session_ = 0;         // plug() changes it, which makes old transports useless
    std::shared_ptr<const Hook> hook_;  // shared, so that its captured counts survive a replacement
};

}  // namespace tacto::test
