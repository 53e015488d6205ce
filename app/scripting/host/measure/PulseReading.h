// PulseReading.h - one reading for a calibration, read off captures: for measure.pulse() and the levels of a
// calibration.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include <nlohmann/json.hpp>

#include "app/scripting/engine/ScriptSession.h"

namespace tacto::host::measure {

/// As measure.pulse() returns it; `handles` are of captures, as session.hold() gives them, at least one. Errors:
/// InvalidArgument for captures that are held no longer; as measureTrains().
[[nodiscard]] Result<nlohmann::json> pulseReading(ScriptSession& session, const nlohmann::json& handles);

}  // namespace tacto::host::measure
