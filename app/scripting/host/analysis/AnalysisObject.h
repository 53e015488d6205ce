// AnalysisObject.h - the functions of the object "analysis"; AnalysisObject.cpp says what each takes and returns.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"

namespace tacto::host::analysis {

using Json = nlohmann::json;

HostCall separability;                  // Separability.cpp
HostCall calibration;                   // Calibration.cpp
HostCall calibrationCheck;              // CalibrationCheck.cpp
HostCall sensorCalibration;             // SensorCalibration.cpp
HostCall sensorScale, fingertipScales;  // FingertipScales.cpp
HostCall loadSafety, loadValue;         // LoadSafety.cpp
HostCall transitions, difference;       // Transitions.cpp
HostCall latency, changes;              // Changes.cpp
HostCall variation, uncertainBench;     // Variation.cpp

/// `first`, and what the scales of a fingertip rest on: weights, gravity and contact area.
[[nodiscard]] std::vector<HostParameter> withWeighing(HostParameter first);

}  // namespace tacto::host::analysis
