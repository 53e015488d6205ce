// PilotObject.h - the functions of the object "pilot"; PilotObject.cpp says what each takes and returns.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include <type_traits>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/HostFunction.h"
#include "app/scripting/engine/ScriptSession.h"
#include "core/pilot/PilotSession.h"

namespace tacto::host::pilot {

using Json = nlohmann::json;

/// What `call(pilot)` answers: JSON, or nothing. Errors: Unsupported outside a study's session; as `call`.
template <class Call>
[[nodiscard]] Result<Json> inPilot(ScriptSession& session, const Call& call) {
    const auto pilot = session.pilot();
    if (!pilot) return failure(pilot);
    if constexpr (std::is_same_v<decltype(call(**pilot)), Result<Json>>)
        return call(**pilot);
    else
        return done(call(**pilot));
}

HostCall begin, skin, sideEffects, ratings, finish, results, blocks;         // Session.cpp
HostCall ascendingLimits, detection, range, comparison;                      // Procedures.cpp
HostCall familiarise, train, testBlock, driftCheck, beforeBlock, takeBreak;  // Procedures.cpp

}  // namespace tacto::host::pilot
