// RandomObject.h - the functions of the object "random"; RandomObject.cpp says what each takes and returns.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"

namespace tacto::host::random {

using Json = nlohmann::json;

/// Limit of a list that blocks() or shuffle() makes.
constexpr double kMaxElements = 1e6;

HostCall blocks, shuffle, uniform, sweeps;  // Random.cpp

}  // namespace tacto::host::random
