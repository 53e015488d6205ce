// TransportPorts.h - where devices of one kind may be plugged in, and the way to them: USB in programs, anything in
// tests.
//
// Thread-safety: one caller at a time, whichever thread: after an unplug the session's thread looks again.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/devices/Transport.h"

namespace tacto {

/// A place where such a device may be; whether it is one it tells when it is asked.
struct TransportPort {
    std::string serial;    ///< USB serial number; may be empty
    std::string place;     ///< which socket, for messages and where there is no serial number
    std::string obstacle;  ///< why it cannot be opened and what helps; empty where it can
};

class TransportPorts {
public:
    virtual ~TransportPorts() = default;
    [[nodiscard]] virtual std::vector<TransportPort> list() const = 0;
    /// Errors: NotFound when it was unplugged meanwhile; as the transport's own.
    [[nodiscard]] virtual Result<std::unique_ptr<Transport>> open(const TransportPort& port) = 0;
};

}  // namespace tacto
