// TransportPorts.h - where devices of one kind may be plugged in, and the way to them: USB in programs, anything in
// tests.
//
// Thread-safety: one caller at a time, whichever thread: after an unplug the session's thread looks again.
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

// Bytes to and from a device: a USB CDC data interface, a pseudo-terminal in tests. A protocol
// makes frames of them, a driver makes a device of frames.
// write() and read() have one caller, the device's session thread; writeUrgent() any thread, at any moment, also while
// those wait.

class Transport {
public:
    static constexpr std::size_t kMaxUrgent = 64;  ///< bytes of one writeUrgent()

    virtual ~Transport() = default;

    /// Sends all of `bytes` as one transfer, so that two writers never mix frames; returns when the device took them.
    /// Errors: Timeout (the rest was cancelled); Device (gone, stalled, took fewer bytes).
    [[nodiscard]] virtual Result<void> write(std::span<const std::uint8_t> bytes, Seconds timeout) = 0;

    /// What has arrived, oldest first, at least one byte; waits for it. A zero timeout looks and does not wait.
    /// What a reader leaves too long is dropped oldest first and counted by dropped().
    /// Errors: Timeout; Device (gone, or the transfer failed).
    [[nodiscard]] virtual Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout) = 0;
    [[nodiscard]] virtual std::uint64_t dropped() const noexcept = 0;

    /// Queues `bytes` (at most kMaxUrgent) for sending at once, behind a transfer that is already under way and
    /// ahead of any later one. Returns without waiting; never throws, never allocates. For the stop.
    virtual void writeUrgent(std::span<const std::uint8_t> bytes) noexcept = 0;
};

/// A place where such a device may be; only its answer shows whether it is one.
struct TransportPort {
    std::string serial;    ///< USB serial number; may be empty
    std::string place;     ///< the socket, for messages and where there is no serial number
    std::string obstacle;  ///< why it cannot be opened and what helps; empty where it can
};

/// What names `port` among `all` in the path of a URI: its serial number, or its place where it has no serial number,
/// or one that another port has too or that a URI cannot hold.
[[nodiscard]] std::string addressOf(const TransportPort& port, std::span<const TransportPort> all);

/// The ports of `all` that a URI's path names, by serial number or by place.
[[nodiscard]] std::vector<TransportPort> portsNamed(std::string_view path, std::span<const TransportPort> all);

/// "pulsepal:A1", "pulsepal:1-2": the addresses of `ports` among `all`.
[[nodiscard]] std::vector<std::string> addressesOf(std::string_view scheme, std::span<const TransportPort> ports,
                                                   std::span<const TransportPort> all);

class TransportPorts {
public:
    virtual ~TransportPorts() = default;
    [[nodiscard]] virtual std::vector<TransportPort> list() const = 0;
    /// Errors: NotFound when it was unplugged meanwhile; as the transport's own.
    [[nodiscard]] virtual Result<std::unique_ptr<Transport>> open(const TransportPort& port) = 0;
};

/// What a driver lists: a device called `name` at each port.
[[nodiscard]] std::vector<DeviceIdentity> identitiesAt(const TransportPorts& ports, std::string_view scheme, Role role,
                                                       std::string_view name);

/// Errors: Io with the port's obstacle; as TransportPorts::open().
[[nodiscard]] Result<std::unique_ptr<Transport>> openPort(TransportPorts& ports, const TransportPort& port);

/// Makes a fresh transport to the same device; called again to reconnect. Errors: NotFound, Io, Device.
using Connect = std::function<Result<std::unique_ptr<Transport>>()>;

/// Opens the port of that address: by serial number wherever it is plugged in now, else in its place. `name`: of the
/// device, for messages.
[[nodiscard]] Connect connectTo(std::shared_ptr<TransportPorts> ports, std::string address, std::string name);

}  // namespace tacto
