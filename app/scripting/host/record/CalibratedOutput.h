// CalibratedOutput.h - what a stored calibration is kept under and looked up by: the day, and the unit of the
// amplitude.
//
// Thread-safety: pure functions.
#pragma once

#include <chrono>
#include <string>

#include "core/calibration/CalibrationStore.h"
#include "core/devices/Stimulator.h"

namespace tacto::host::record {

/// Today by the wall clock: a calibration's date is the laboratory's, not the bench clock's.
[[nodiscard]] inline CalibrationDate today() {
    return std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
}

[[nodiscard]] inline std::string unitOf(const Stimulator& stimulator) {
    return stimulator.traits().drive == Drive::Current ? "mA" : "V";
}

}  // namespace tacto::host::record
