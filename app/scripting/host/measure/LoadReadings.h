// LoadReadings.h - what trains did to a load, read off captures: for measure.load() and the checks on loads.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include <nlohmann/json.hpp>

#include "app/scripting/engine/ScriptSession.h"

namespace tacto::host::measure {

/// Handles of captures, as session.hold() gives them; an empty list where there are none.
struct LoadCaptures {
    nlohmann::json trains = nlohmann::json::array();  ///< one per train, all with one command
    nlohmann::json fine = nlohmann::json::array();    ///< in a current range that fits the end of a phase
    nlohmann::json rhythm = nlohmann::json::array();  ///< at most one, that holds two trains
    bool byVoltage = false;                           ///< voltage shows the phases, also of a current source
};

/// As measure.load() returns it. Errors: InvalidArgument for captures that are held no longer; as readLoad().
[[nodiscard]] Result<nlohmann::json> loadReading(ScriptSession& session, const LoadCaptures& captures);

}  // namespace tacto::host::measure
