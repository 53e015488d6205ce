// The procedures of a pilot session; what each does stands in core/pilot.
#include "app/scripting/host/pilot/PilotObject.h"

namespace tacto::host::pilot {

Result<Json> ascendingLimits(ScriptSession& session, const Arguments&) {
    return inPilot(session, [](PilotSession& pilot) { return pilot.thresholds().ascendingLimits(); });
}

Result<Json> detection(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) -> Result<Json> {
        const auto method = detectionMethodFrom(arguments.text("options.method"));
        if (!method) return failure(method);
        return done(pilot.thresholds().detection(*method));
    });
}

Result<Json> range(ScriptSession& session, const Arguments&) {
    return inPilot(session, [](PilotSession& pilot) -> Result<Json> {
        if (auto found = pilot.thresholds().range(); !found) return failure(found);
        return Json(pilot.thresholds().rangeJson());
    });
}

Result<Json> comparison(ScriptSession& session, const Arguments&) {
    return inPilot(session, [](PilotSession& pilot) { return pilot.thresholds().comparison(); });
}

Result<Json> familiarise(ScriptSession& session, const Arguments&) {
    return inPilot(session, [](PilotSession& pilot) { return pilot.identification().familiarise(); });
}

Result<Json> train(ScriptSession& session, const Arguments&) {
    return inPilot(session, [](PilotSession& pilot) { return pilot.identification().train(); });
}

Result<Json> beforeBlock(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) { return pilot.beforeBlock(arguments.whole("block")); });
}

Result<Json> driftCheck(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) -> Result<Json> {
        const auto goesOn = pilot.identification().driftCheck(arguments.whole("block"));
        if (!goesOn) return failure(goesOn);
        return Json(*goesOn);
    });
}

Result<Json> testBlock(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session,
                   [&](PilotSession& pilot) { return pilot.identification().testBlock(arguments.whole("block")); });
}

Result<Json> takeBreak(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) {
        return pilot.identification().takeBreak(arguments.whole("block"), Seconds(arguments.number("seconds")));
    });
}

}  // namespace tacto::host::pilot
