#include "app/run/KnownCalibration.h"

#include <chrono>
#include <fmt/format.h>
#include <utility>

#include "core/calibration/CalibrationStore.h"

namespace tacto {

KnownCalibration knownCalibration(const DeviceSet& devices) {
    if (!devices.stimulator) return {};
    const auto notCalibrated = [](const Error& why) {
        return KnownCalibration{{}, fmt::format("not calibrated: {}", why.message)};
    };
    auto store = CalibrationStore::open(calibrationFile());
    if (!store) return notCalibrated(store.error());
    const auto& device = devices.stimulator->identity();
    const std::string_view unit = devices.stimulator->traits().drive == Drive::Current ? "mA" : "V";
    const CalibrationDate today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
    const auto found = store->valid(device.serial, unit, today, device.simulated);
    if (!found) return notCalibrated(found.error());
    const AmplitudeCalibration calibration{found->gain, found->offset, found->lowest, found->highest};
    if (const auto sound = validate(calibration); !sound) return notCalibrated(sound.error());
    return {calibration,
            fmt::format("calibrated {}, until {}: gain {:.5g}, offset {:.3g} {}, U {:.2g} % of the command; applied",
                        dateText(found->made), dateText(found->validUntil), found->gain, found->offset, found->unit,
                        found->uncertainty_pct)};
}

void applyKnown(KnownCalibration known, BenchConfig& config) {
    config.calibration = known.calibration;
    config.calibrationText = std::move(known.text);
}

}  // namespace tacto
