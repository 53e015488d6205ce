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

/// Connected until the operator says otherwise.
inline constexpr const char* kDefaultLoad = "1 kohm";

/// What drivers may know of the run they open devices for.
struct OpenContext {
    const Clock& clock;  ///< outlives the devices
    std::uint64_t seed = 1;
    std::string declaredLoad =
        kDefaultLoad;  ///< what the operator says is connected; the simulated load unless `load=` says otherwise
    /// Outlives the opening; null: nothing stops it. `asked` is when the operator asked for the devices.
    const StopCounter* stops = nullptr;
    StopMark asked = {};
    [[nodiscard]] bool stopped() const noexcept { return stops != nullptr && stops->movedSince(asked); }
};

class Driver {
public:
    virtual ~Driver() = default;
    [[nodiscard]] virtual std::string_view scheme() const noexcept = 0;
    /// What is present now. Never fails: what cannot be reached is not listed; what is there and may not be opened
    /// names its obstacle. May look at ports and files: not for a window's thread.
    [[nodiscard]] virtual std::vector<DeviceIdentity> list() const = 0;
    /// True when devices of this scheme can live on the virtual clock (simulated, or read from files).
    [[nodiscard]] virtual bool runsOnVirtualClock() const noexcept = 0;
    /// Opens the devices of `uri` into `into`. A uri without a single device (such as "sim:") fills those of `wanted`
    /// that are still empty. Errors: InvalidArgument naming the parameter and what it takes; NotFound; Device.
    [[nodiscard]] virtual Result<void> open(const DeviceUri& uri, const std::set<Role>& wanted,
                                            const OpenContext& context, DeviceSet& into) = 0;
};

}  // namespace tacto
