// PilotObject.h - the functions of the object "pilot"; PilotObject.cpp says what each takes and returns.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"

namespace tacto::host::pilot {

using Json = nlohmann::json;

HostCall begin, skin, sideEffects, ratings, finish, results, blocks;         // Session.cpp
HostCall ascendingLimits, detection, range, comparison;                      // Procedures.cpp
HostCall familiarise, train, testBlock, driftCheck, beforeBlock, takeBreak;  // Procedures.cpp

}  // namespace tacto::host::pilot
