// Changes.h - steps of the finger and its movements through the R-P plane, as the oscilloscope sees them.
#pragma once

#include "app/scripting/engine/ScriptSession.h"
#include "core/analysis/transitions/TransitionsJson.h"

namespace tacto::host::transitions {

using Json = nlohmann::json;

struct Place {
    double roughness = 0;
    double pressure = 0;
};

/// Lets trains run at `from`, steps to `to`, `phase` of an interval after a train, and watches the trains that follow,
/// each in a record of its own. Errors: InvalidArgument for a step below a just-noticeable difference; Timeout where
/// the oscilloscope sees no two trains before the step; a stop.
[[nodiscard]] Result<CapturedChange> captureStep(ScriptSession& session, const Place& from, const Place& to,
                                                 double phase);
/// Moves to `to` in so many seconds, and back, while the oscilloscope looks at every train.
[[nodiscard]] Result<CapturedChange> captureMovement(ScriptSession& session, const Place& from, const Place& to,
                                                     double seconds);

}  // namespace tacto::host::transitions
