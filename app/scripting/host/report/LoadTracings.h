// LoadTracings.h - the figures of a load-safety check: what the strongest commands look like on loads.
#pragma once

#include <nlohmann/json.hpp>

#include "app/scripting/engine/ScriptSession.h"

namespace tacto::host::report {

/// Report items: the single pulses into `loads`, as loadRecordFrom() reads them, on one time axis, and the burst
/// of captureBurst() with its load and condition, on another. `burst` null: none was captured.
[[nodiscard]] nlohmann::json loadTracings(ScriptSession& session, const nlohmann::json& loads,
                                          const nlohmann::json& burst);

}  // namespace tacto::host::report
