// GeneralObject.h - the functions that belong to no object; GeneralObject.cpp says what each takes and returns.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"

namespace tacto::host::general {

using Json = nlohmann::json;

HostCall protocol, progress, verdict, log;  // General.cpp

}  // namespace tacto::host::general
