// DeviceLine.h - an emulated device at the other end of a Transport, in this process: what the lines of all emulators
// share. A line of one adds how its device takes and gives bytes.
//
// On a virtual clock a waiting read moves the clock, so it must be the clock's only mover meanwhile; on a steady clock
// it waits. The line outlives its transports: the output can be judged after the driver has closed.
//
// Thread-safety: every public function from any thread.
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

    /// A transport to the device. Errors: NotFound while unplugged.
    [[nodiscard]] Result<std::unique_ptr<Transport>> connect();
    [[nodiscard]] Connect connector();
    void unplug();
    /// Earlier transports are of no more use.
    void plug();
    [[nodiscard]] bool plugged() const;
    /// Bytes of every write() and writeUrgent() so far, one entry a transfer.
    [[nodiscard]] std::vector<std::vector<std::uint8_t>> written();
    /// Called in every write(), before its bytes reach the device; empty: nothing is.
    void onWrite(Hook hook);

protected:
    /// `movable` is `clock` itself where it is virtual, else null. `name` as in "the emulated NAME is unplugged".
    DeviceLine(const Clock& clock, VirtualClock* movable, std::string name);

    // The device's side, called with mutex_ held.
    [[nodiscard]] virtual Result<void> receive(std::span<const std::uint8_t> bytes, Instant now) = 0;
    virtual void receiveUrgent(std::span<const std::uint8_t> bytes, Instant now) noexcept = 0;
    [[nodiscard]] virtual std::size_t transmit(std::span<std::uint8_t> into, Instant now) = 0;
    /// The time when it may have bytes for the host; nothing: not before something is written.
    [[nodiscard]] virtual std::optional<Instant> nextTransmit(Instant now) = 0;
    /// What came meanwhile is heard before anything else happens.
    virtual void catchUp(Instant) {}
    virtual void connected() {}
    virtual void powerCycle(Instant) {}

    /// Calls `look(device, now)` while nothing else does.
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
    std::uint64_t session_ = 0;         // plug() makes old transports useless
    std::shared_ptr<const Hook> hook_;  // shared, so that it keeps what it counts
};

}  // namespace tacto::test
