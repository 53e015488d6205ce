// Device.h - what every device has. A device is opened by its driver, owned by one session thread and
// closed by destruction. What it can do is which of the interfaces below it implements: a missing
// ability is a missing interface.
//
// Thread-safety: identity() is constant while the device is open; the rest as its interface says.
#pragma once

#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/base/Role.h"
#include "core/base/Units.h"

namespace tacto {

struct DeviceIdentity {
    std::string uri;  ///< opens this device again
    Role role;
    std::string name;
    std::string serial;
    std::string firmware;
    bool simulated = false;
    /// Why a listed device cannot be opened now and what helps, one sentence; empty where it can.
    std::string obstacle = {};
    bool placeholder = false;  ///< listed as a kind: the path of `uri` has to be filled in
    bool operator==(const DeviceIdentity&) const = default;
};

class Device {
public:
    virtual ~Device() = default;
    [[nodiscard]] virtual const DeviceIdentity& identity() const noexcept = 0;
};

}  // namespace tacto
