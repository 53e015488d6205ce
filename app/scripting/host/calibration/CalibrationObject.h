// CalibrationObject.h - the functions of the object "calibration"; CalibrationObject.cpp says what each takes and
// returns.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"

namespace tacto::host::calibration {

using Json = nlohmann::json;

HostCall readKnownLoad, warmUp, beginLevels, readLevel;                               // Levels.cpp
HostCall checkRanges, knownRanges, judge, timeBase, checkVerdict, stimulatorVerdict;  // Stimulator.cpp
HostCall knownWeight, weighings, slideRow, sensorVerdict;                             // Fingertip.cpp

}  // namespace tacto::host::calibration
