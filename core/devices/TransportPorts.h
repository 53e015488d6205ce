// TransportPorts.h - where devices of one kind may be plugged in, and the way to them: USB in programs, anything in
// tests.
//
// Thread-safety: one caller at a time, whichever thread: after an unplug the session's thread looks again.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/devices/Transport.h"

namespace tacto {

/// A place where such a device may be; whether it is one it tells when it is asked.
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

/// "pulsepal:A1 or pulsepal:1-2": the addresses of `ports` among `all`, to be chosen from.
[[nodiscard]] std::string choiceOf(std::string_view scheme, std::span<const TransportPort> ports,
                                   std::span<const TransportPort> all);

class TransportPorts {
public:
    virtual ~TransportPorts() = default;
    [[nodiscard]] virtual std::vector<TransportPort> list() const = 0;
    /// Errors: NotFound when it was unplugged meanwhile; as the transport's own.
    [[nodiscard]] virtual Result<std::unique_ptr<Transport>> open(const TransportPort& port) = 0;
};

}  // namespace tacto
