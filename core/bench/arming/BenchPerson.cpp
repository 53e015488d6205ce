#include "core/bench/arming/BenchPerson.h"

#include "core/devices/StatesCalibration.h"

namespace tacto {

Result<void> checkWhere(const BenchConfig& config) {
    const bool hasPerson = config.mode == OutputMode::Person || config.person;
    if (!hasPerson && !config.virtualParticipant) return {};
    for (const Device* device : {static_cast<const Device*>(config.devices.stimulator.get()),
                                 static_cast<const Device*>(config.devices.massager.get())}) {
        if (device == nullptr) continue;
        const auto& identity = device->identity();
        if (config.virtualParticipant && !identity.simulated) {
            return fail(ErrorCode::InvalidArgument,
                        "a virtual participant cannot use the real device {}; use a simulated one", identity.name);
        }
        if (!config.virtualParticipant && identity.simulated && !config.rehearsal) {
            return fail(ErrorCode::InvalidArgument,
                        "a person on {}, which delivers nothing; a device is accepted, a simulated one in a rehearsal",
                        identity.name);
        }
    }
    return {};
}

BenchConfig withStatedCalibration(BenchConfig config) {
    const auto* stimulator = config.devices.stimulator.get();
    if (config.mode != OutputMode::Person || config.calibration || stimulator == nullptr) return config;
    if (!stimulator->identity().simulated) return config;
    const auto* stating = dynamic_cast<const StatesCalibration*>(stimulator);
    if (stating == nullptr || !stating->statedCalibration()) return config;
    config.calibration = stating->statedCalibration();
    config.calibrationHolds = true;
    config.calibratedUntil.reset();
    config.calibrationText = "as the simulated stimulator states";
    return config;
}

}  // namespace tacto
