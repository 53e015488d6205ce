// Changes.h - steps and movements of the finger in roughness R and pressure P, as the oscilloscope sees them.
#pragma once

#include "app/scripting/engine/ScriptSession.h"
#include "core/analysis/transitions/TransitionsJson.h"

namespace tacto::host::transitions {

using Json = nlohmann::json;

struct Place {
    double roughness = 0;
    double pressure = 0;
};

/// Lets trains run at `from`, steps to `to` at `phase` of an interval after a train, and captures the following trains,
/// each in its own record. Errors: InvalidArgument for a step below a just-noticeable difference; Timeout if the
/// oscilloscope sees fewer than two trains before the step; a stop.
[[nodiscard]] Result<CapturedChange> captureStep(ScriptSession& session, const Place& from, const Place& to,
                                                 double phase);
/// Moves to `to` in `seconds` and back, while the oscilloscope captures every train.
[[nodiscard]] Result<CapturedChange> captureMovement(ScriptSession& session, const Place& from, const Place& to,
                                                     double seconds);
/// Has the finger slide as for `from`, then as for `to` (bench::slidingFor()), and captures every train that it drives
/// until they are steady. Errors: Unsupported without a fingertip; Timeout if they do not become steady; as
/// bench::slide() and Bench::drive(); a stop.
[[nodiscard]] Result<CapturedChange> capturePress(ScriptSession& session, const Place& from, const Place& to);

}  // namespace tacto::host::transitions
