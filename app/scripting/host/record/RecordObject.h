// RecordObject.h - the functions of the object "record"; RecordObject.cpp says what each takes and returns.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"

namespace tacto::host::record {

using Json = nlohmann::json;

HostCall trial, trials, measurement, event, partial;  // Rows.cpp
HostCall reference;                                   // Reference.cpp
HostCall keepCalibration;                             // Calibration.cpp
HostCall keepProfile;                                 // SensorProfile.cpp

}  // namespace tacto::host::record
