// TransportPorts.h - where devices of one kind may be plugged in, and how to reach them: by USB in programs, by any
// transport in tests.
//
// Thread-safety: one caller at a time, on any thread: after an unplug the session's thread searches again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/devices/Device.h"

namespace tacto {

// Sends bytes to a device and receives them: a USB CDC data interface, or a pseudo-terminal in tests. A protocol turns
// the bytes into frames; a driver uses the frames. write() and read() have one caller, the device's session thread;
// writeUrgent() any thread, at any moment, even while write() or read() waits.

class Transport {
public:
    static constexpr std::size_t kMaxUrgent = 64;  ///< most bytes in one writeUrgent()

    virtual ~Transport() = default;

    /// Sends all of `bytes` as one transfer, so that the frames of two writers never mix; returns once the device took
    /// them. Errors: Timeout (the rest was cancelled); Device (gone, stalled, took fewer bytes).
    [[nodiscard]] virtual Result<void> write(std::span<const std::uint8_t> bytes, Seconds timeout) = 0;

    /// Waits for at least one byte and returns what has arrived, oldest first. With a zero timeout it does not wait.
    /// Bytes that are not read in time are dropped, oldest first, and counted by dropped().
    /// Errors: Timeout; Device (gone, or the transfer failed).
    [[nodiscard]] virtual Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout) = 0;
    [[nodiscard]] virtual std::uint64_t dropped() const noexcept = 0;

    /// Queues `bytes` (at most kMaxUrgent) to be sent at once, after a transfer in progress and before any later one.
    /// Returns without waiting; never throws, never allocates. Used for the stop.
    virtual void writeUrgent(std::span<const std::uint8_t> bytes) noexcept = 0;
};

/// A place where such a device may be; only an answer shows whether the device is one.
struct TransportPort {
    std::string serial;    ///< USB serial number; may be empty
    std::string place;     ///< the socket, for messages and for devices without a serial number
    std::string obstacle;  ///< why it cannot be opened and what helps; empty if it can
};

/// Returns the name of `port` among `all` in a URI's path: its serial number, or its place if the serial number is
/// missing, belongs to another port, too, or does not fit into a URI.
[[nodiscard]] std::string addressOf(const TransportPort& port, std::span<const TransportPort> all);

/// Returns the ports in `all` that a URI's path names, by serial number or by place.
[[nodiscard]] std::vector<TransportPort> portsNamed(std::string_view path, std::span<const TransportPort> all);

/// Returns the addresses of `ports` among `all`: "pulsepal:A1", "pulsepal:1-2".
[[nodiscard]] std::vector<std::string> addressesOf(std::string_view scheme, std::span<const TransportPort> ports,
                                                   std::span<const TransportPort> all);

class TransportPorts {
public:
    virtual ~TransportPorts() = default;
    [[nodiscard]] virtual std::vector<TransportPort> list() const = 0;
    /// Errors: NotFound if the port was unplugged meanwhile; as the transport.
    [[nodiscard]] virtual Result<std::unique_ptr<Transport>> open(const TransportPort& port) = 0;
};

/// Returns a driver's list of devices: one called `name` at each port.
[[nodiscard]] std::vector<DeviceIdentity> identitiesAt(const TransportPorts& ports, std::string_view scheme, Role role,
                                                       std::string_view name);

/// Errors: Io with the port's obstacle; as TransportPorts::open().
[[nodiscard]] Result<std::unique_ptr<Transport>> openPort(TransportPorts& ports, const TransportPort& port);

/// Makes a new transport to the same device; also used to reconnect. Errors: NotFound, Io, Device.
using Connect = std::function<Result<std::unique_ptr<Transport>>()>;

/// Opens the port with that address: by serial number wherever it is plugged in now, else at its place. `name` is the
/// device's name in messages.
[[nodiscard]] Connect connectTo(std::shared_ptr<TransportPorts> ports, std::string address, std::string name);

}  // namespace tacto
