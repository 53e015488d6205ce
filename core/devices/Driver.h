// Driver.h - opens devices of one URI scheme. Programs list their drivers explicitly, in
// app/run/AllDrivers.cpp.
//
// Thread-safety: one caller.
#pragma once

#include <memory>
#include <set>
#include <span>
#include <vector>

#include "core/base/Clock.h"
#include "core/devices/DeviceUri.h"
#include "core/devices/Massager.h"
#include "core/devices/Oscilloscope.h"
#include "core/devices/Stimulator.h"
#include "core/devices/TactileSensor.h"
#include "core/measure/InstrumentStatement.h"
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

/// The open devices of a bench, at most one per role. Owns them.
struct DeviceSet {
    std::unique_ptr<TactileSensor> sensor;
    std::unique_ptr<Stimulator> stimulator;
    std::unique_ptr<Oscilloscope> oscilloscope;
    std::unique_ptr<Massager> massager;
    InstrumentStatement scopeStatement;  ///< of the oscilloscope, beside what its captures state themselves
    /// The keys of its address that said so, as they were given: part of the address that identities() gives.
    std::vector<std::pair<std::string, std::string>> scopeKeys;
    std::shared_ptr<SurfacePresenter> surface;    ///< null: the operator presents surfaces
    std::shared_ptr<LoadFitter> load;             ///< null: the operator fits loads
    std::shared_ptr<VoltageReference> reference;  ///< null: the operator connects a reference source

    [[nodiscard]] bool has(Role role) const noexcept;
    /// Errors: InvalidArgument where the role that `uri` is to fill has its device already.
    [[nodiscard]] Result<void> checkFree(Role role, const DeviceUri& uri) const;
    [[nodiscard]] std::vector<DeviceIdentity> identities() const;
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
    /// Opens what `uri` names into `into`. A uri that names no single device (as "sim:") fills those of `wanted`
    /// that are still empty. Errors: InvalidArgument naming the parameter and what it takes; NotFound; Device.
    [[nodiscard]] virtual Result<void> open(const DeviceUri& uri, const std::set<Role>& wanted,
                                            const OpenContext& context, DeviceSet& into) = 0;
};

/// The drivers of a program, in the order given. Opens lists of URIs, the ones naming a single device first.
class Registry {
public:
    explicit Registry(std::vector<std::unique_ptr<Driver>> drivers);
    [[nodiscard]] std::vector<DeviceIdentity> list() const;
    /// Whether every one of `uris` can run on the virtual clock. Errors: as open().
    [[nodiscard]] Result<bool> allVirtual(std::span<const DeviceUri> uris) const;
    /// The keys of StatementKeys.h are taken from the address of the oscilloscope.
    /// A stop ends the opening as soon as the driver that is at work returns; what was opened is switched off and
    /// closed. Errors: Stopped; NotFound naming the unknown scheme and the known ones, or the role that nothing fills;
    /// as Driver::open().
    [[nodiscard]] Result<DeviceSet> open(std::span<const DeviceUri> uris, const std::set<Role>& needed,
                                         const OpenContext& context);

private:
    [[nodiscard]] Result<Driver*> driverFor(const DeviceUri& uri) const;
    std::vector<std::unique_ptr<Driver>> drivers_;
};

}  // namespace tacto
