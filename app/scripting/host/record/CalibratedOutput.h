// CalibratedOutput.h - the unit of the amplitude that a stored calibration is kept under and looked up by.
//
// Thread-safety: pure functions.
#pragma once

#include <string>

#include "core/calibration/CalibrationStore.h"
#include "core/devices/Stimulator.h"

namespace tacto::host::record {

[[nodiscard]] inline std::string unitOf(const Stimulator& stimulator) {
    return stimulator.traits().drive == Drive::Current ? "mA" : "V";
}

}  // namespace tacto::host::record
