#include "app/run/KnownCalibration.h"

#include <fmt/format.h>
#include <utility>

#include "core/calibration/CalibrationStore.h"
#include "core/devices/DeviceUri.h"

namespace tacto {

namespace {

std::string lineText(std::string_view what, const StoredLine& line, std::string_view unit, double perUnit) {
    return fmt::format("{} gain {:.5g}, offset {:.3g} {}, U {:.2g} %", what, line.gain, perUnit * line.offset, unit,
                       line.uncertainty_pct);
}

}  // namespace

KnownCalibration knownCalibration(const DeviceSet& devices) {
    if (!devices.stimulator) return {};
    auto store = CalibrationStore::open(calibrationFile());
    if (!store)
        return {.calibration = {}, .until = {}, .text = fmt::format("not calibrated: {}", store.error().message)};
    const auto& device = devices.stimulator->identity();
    const auto output = calibratedOutput(device.serial, device.uri);
    const std::string_view unit = amplitudeUnit(devices.stimulator->traits().drive);
    KnownCalibration known;
    const auto* last = store->proven(output, unit, device.simulated);
    if (last != nullptr) known.calibration = linesOf(*last);
    const CalibrationDate today = utcToday();
    const auto found = store->valid(output, unit, today, device.simulated);
    known.holds = found.has_value();
    if (found) known.until = found->validUntil;
    if (!found) {
        known.text = fmt::format("not calibrated: {}", found.error().message);
    } else if (const auto sound = validate(*known.calibration); !sound) {
        known.text = sound.error().message;
    } else {
        known.text = fmt::format("calibrated {}, until {}; applied: {}", dateText(found->made),
                                 dateText(found->validUntil), lineText("amplitude", found->amplitude, found->unit, 1));
        for (const auto& time : kStoredTimes)
            known.text += "; " + lineText(time.words, *((*found).*time.line), "us", 1e6);
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
