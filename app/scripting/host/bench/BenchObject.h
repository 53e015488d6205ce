// BenchObject.h - the functions of the object "bench"; BenchObject.cpp says what each takes and returns.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"

namespace tacto::host::bench {

using Json = nlohmann::json;

/// Fits `load`: by itself on a simulated bench, else the operator does, asked `request` under the name `question`.
/// Output that is on stays on.
[[nodiscard]] Result<void> changeLoad(ScriptSession& session, const std::string& load, const char* question,
                                      const std::string& request);

HostCall arm, disarm, wait, drive, fitLoad;  // Output.cpp
HostCall capture;                            // Captures.cpp
HostCall loads, predict, attempt;            // Prediction.cpp
HostCall setEncoding, setElectrodeArea, electrodeArea, storedCalibration, useCalibration,
    useFingertipScales;                                                         // RunSettings.cpp
HostCall conditions, live, watch, exposure, finished, replayed, time, devices;  // State.cpp
HostCall present, lift, measureReference, setReferences;                        // Surfaces.cpp
HostCall streams, measureRest, measureSlide, measureWeight;                     // Fingertip.cpp
HostCall profilometer, surfaces, weights;                                       // GivenSurfaces.cpp
HostCall readReference;                                                         // AbsoluteReference.cpp
HostCall readKnownLoad;                                                         // KnownLoad.cpp
HostCall step, traverse;                                                        // Steps.cpp
HostCall inChecking, whileDelivering, bySilence;                                // Trips.cpp

}  // namespace tacto::host::bench
