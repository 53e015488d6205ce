// TransportPorts.h - where devices of one kind may be plugged in, and the way to them: USB in programs, anything in
// tests.
//
// Thread-safety: one caller at a time, whichever thread: after an unplug the session's thread looks again.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/devices/Device.h"
#include "core/devices/Transport.h"

namespace tacto {

/// A place where such a device may be; only its answer shows whether it is one.
struct TransportPort {
    std::string serial;    ///< USB serial number; may be empty
    std::string place;     ///< which socket, for messages and where there is no serial number
    std::string obstacle;  ///< why it cannot be opened and what helps; empty where it can
};

/// What names `port` among `all` in the path of a URI: its serial number, or its place where it has no serial number,
/// or one that another port has too or that a URI cannot hold.
[[nodiscard]] std::string addressOf(const TransportPort& port, std::span<const TransportPort> all);

/// Those of `all` that a URI's path names, by serial number or by place.
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
