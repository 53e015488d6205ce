// DeviceSettings.h - reads and checks the parameters in the URI of each simulated device.
//
// Thread-safety: pure functions.
#pragma once

#include <optional>
#include <string>

#include "core/base/Result.h"
#include "core/devices/DeviceUri.h"
#include "core/electrode/Load.h"
#include "drivers/simulated/Finger.h"
#include "drivers/simulated/SimulatedMassager.h"
#include "drivers/simulated/SimulatedOscilloscope.h"
#include "drivers/simulated/SimulatedSensor.h"
#include "drivers/simulated/SimulatedStimulator.h"

namespace tacto::sim {

struct FingerAndSensor {
    FingerSettings finger;
    SensorSettings sensor;
};
struct StimulatorAndLoad {
    StimulatorSettings stimulator;
    std::optional<Load> load;  ///< the load given by `load=`
};
struct ScopeAndFlaws {
    ScopeTraits traits;
    ScopeFlaws flaws;
};

/// Errors of each function: InvalidArgument naming the key, its value and what is accepted.
[[nodiscard]] Result<FingerAndSensor> readFinger(const DeviceUri& uri, std::uint64_t seed);
[[nodiscard]] Result<StimulatorAndLoad> readStimulator(const DeviceUri& uri, std::uint64_t seed);
[[nodiscard]] Result<ScopeAndFlaws> readOscilloscope(const DeviceUri& uri, std::uint64_t seed);
[[nodiscard]] Result<MassagerSettings> readMassager(const DeviceUri& uri);

}  // namespace tacto::sim
