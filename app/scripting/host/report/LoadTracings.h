// LoadTracings.h - the figures of a load-safety check: traces of the strongest commands on loads.
#pragma once

#include <nlohmann/json.hpp>

#include "app/scripting/engine/ScriptSession.h"

namespace tacto::host::report {

/// Returns report items: the single pulses into `loads` (see loadRecordFrom()) on one time axis, and the burst of
/// captureBurst() with its load and condition on another. `burst` is null if none was captured.
[[nodiscard]] nlohmann::json loadTracings(ScriptSession& session, const nlohmann::json& loads,
                                          const nlohmann::json& burst);

}  // namespace tacto::host::report
