// LoadsObject.h - the functions of the object "loads"; LoadsObject.cpp says what each takes and returns.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"

namespace tacto::host::loads {

using Json = nlohmann::json;

HostCall commands, strongest;  // Commands.cpp
HostCall arm, askToArm;        // ArmOnLoad.cpp
HostCall give, burst;          // Delivery.cpp

}  // namespace tacto::host::loads
