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

/// The open devices of a bench, at most one for each role. Owns them.
struct DeviceSet {
    std::unique_ptr<TactileSensor> sensor;
    std::unique_ptr<Stimulator> stimulator;
    std::unique_ptr<Oscilloscope> oscilloscope;
    std::unique_ptr<Massager> massager;
    InstrumentStatement scopeStatement;  ///< accuracy of the oscilloscope, in addition to what captures state
    /// The keys of the oscilloscope's address that stated the accuracy; identities() adds them to the address again.
    std::vector<std::pair<std::string, std::string>> scopeKeys;
    std::shared_ptr<SurfacePresenter> surface;    ///< null: the operator presents the surfaces
    std::shared_ptr<LoadFitter> load;             ///< null: the operator connects the loads
    std::shared_ptr<VoltageReference> reference;  ///< null: the operator connects a reference source

    [[nodiscard]] bool has(Role role) const noexcept;
    /// Errors: InvalidArgument if another device already has the role of `uri`.
    [[nodiscard]] Result<void> checkFree(Role role, const DeviceUri& uri) const;
    [[nodiscard]] std::vector<DeviceIdentity> identities() const;
};

}  // namespace tacto
