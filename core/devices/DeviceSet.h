// DeviceSet.h - the open devices of a bench.
//
// Thread-safety: one caller.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/devices/DeviceUri.h"
#include "core/devices/Oscilloscope.h"
#include "core/devices/Stimulator.h"
#include "core/devices/TactileSensor.h"
#include "core/measure/InstrumentStatement.h"

namespace tacto {

/// The open devices of a bench, at most one per role. Owns them.
struct DeviceSet {
    std::unique_ptr<TactileSensor> sensor;
    std::unique_ptr<Stimulator> stimulator;
    std::unique_ptr<Oscilloscope> oscilloscope;
    std::unique_ptr<Massager> massager;
    InstrumentStatement scopeStatement;  ///< the oscilloscope's, beside what its captures state themselves
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

}  // namespace tacto
