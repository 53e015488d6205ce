// MeasureObject.h - the functions of the object "measure"; MeasureObject.cpp says what each takes and returns.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"

namespace tacto::host::measure {

using Json = nlohmann::json;

HostCall train;        // Train.cpp
HostCall pulse;        // Pulse.cpp
HostCall measureLoad;  // Load.cpp

}  // namespace tacto::host::measure
