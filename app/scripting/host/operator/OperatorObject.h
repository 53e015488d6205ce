// OperatorObject.h - the functions of the object "operator"; OperatorObject.cpp says what each takes and returns.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"

namespace tacto::host::operators {

using Json = nlohmann::json;

HostCall confirm, choose, enter, wired;  // Questions.cpp

}  // namespace tacto::host::operators
