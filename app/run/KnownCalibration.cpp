#include "app/run/KnownCalibration.h"

#include <chrono>
#include <fmt/format.h>
#include <utility>

#include "core/calibration/CalibrationStore.h"
#include "core/devices/DeviceUri.h"

namespace tacto {

KnownCalibration knownCalibration(const DeviceSet& devices) {
    if (!devices.stimulator) return {};
    auto store = CalibrationStore::open(calibrationFile());
    if (!store)
        return {.calibration = {}, .until = {}, .text = fmt::format("not calibrated: {}", store.error().message)};
    const auto& device = devices.stimulator->identity();
    const auto output = calibratedOutput(device.serial, device.uri);
    const std::string_view unit = devices.stimulator->traits().drive == Drive::Current ? "mA" : "V";
    KnownCalibration known;
    const auto* last = store->latest(output, unit);
    if (last != nullptr) known.calibration = {last->gain, last->offset, last->lowest, last->highest};
    const CalibrationDate today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
    const auto found = store->valid(output, unit, today, device.simulated);
    known.holds = found.has_value();
    if (found) known.until = found->validUntil;
    if (!found) {
        known.text = fmt::format("not calibrated: {}", found.error().message);
    } else if (const auto sound = validate(*known.calibration); !sound) {
        known.text = sound.error().message;
    } else {
        known.text =
            fmt::format("calibrated {}, until {}: gain {:.5g}, offset {:.3g} {}, U {:.2g} % of the command; applied",
                        dateText(found->made), dateText(found->validUntil), found->gain, found->offset, found->unit,
                        found->uncertainty_pct);
    }
    return known;
}

void applyKnown(KnownCalibration known, BenchConfig& config) {
    config.calibration = known.calibration;
    config.calibrationHolds = known.holds;
    config.calibratedUntil = known.until;
    config.calibrationText = std::move(known.text);
}

}  // namespace tacto
