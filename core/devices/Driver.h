// Driver.h - opens devices of one URI scheme. Programs list their drivers explicitly, in app/run/AllDrivers.cpp.
//
// Thread-safety: one caller.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Clock.h"
#include "core/devices/DeviceSet.h"
#include "core/devices/DeviceUri.h"
#include "core/safety/StopCounter.h"

namespace tacto {

/// The load assumed until the operator declares another.
inline constexpr const char* kDefaultLoad = "1 kohm";

/// What a driver may know of the run for which it opens devices.
struct OpenContext {
    const Clock& clock;  ///< the clock outlives the devices
    std::uint64_t seed = 1;
    std::string declaredLoad =
        kDefaultLoad;  ///< the load stated by the operator; the simulated load unless `load=` is given
    /// Outlives the opening; null: no stop ends the opening. `asked` is when the operator asked for the devices.
    const StopCounter* stops = nullptr;
    StopMark asked = {};
    [[nodiscard]] bool stopped() const noexcept { return stops != nullptr && stops->movedSince(asked); }
};

class Driver {
public:
    virtual ~Driver() = default;
    [[nodiscard]] virtual std::string_view scheme() const noexcept = 0;
    /// Lists the devices present now. Never fails: an unreachable device is not listed; a device that may not be opened
    /// is listed with its obstacle. May search ports and files: not for a window's thread.
    [[nodiscard]] virtual std::vector<DeviceIdentity> list() const = 0;
    /// True if devices of this scheme can run on the virtual clock (simulated, or read from files).
    [[nodiscard]] virtual bool runsOnVirtualClock() const noexcept = 0;
    /// Opens the devices of `uri` into `into`. A uri that names no single device (such as "sim:") fills the roles in
    /// `wanted` that are still empty. Errors: InvalidArgument naming the parameter and its values; NotFound; Device.
    [[nodiscard]] virtual Result<void> open(const DeviceUri& uri, const std::set<Role>& wanted,
                                            const OpenContext& context, DeviceSet& into) = 0;
};

}  // namespace tacto
