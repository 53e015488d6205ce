// Arming on a load of the set: what is wrong with the load ends its part, a fault or a stop ends the run.
#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/bench/Prediction.h"
#include "app/scripting/host/loads/LoadsObject.h"

namespace tacto::host::loads {

namespace {

/// Nothing when armed, else what is wrong with this load. Errors: a fault, a stop, no confirmation.
Result<std::optional<Error>> tryToArm(ScriptSession& session, const std::string& load) {
    const auto request = confirmedArming(session, load);
    if (!request) return failure(request);
    const auto armed = session.bench().arm(*request);
    if (armed) return std::optional<Error>();
    session.bench().disarm();
    const bool isOver = session.bench().telemetry().state != InterlockState::Disarmed;
    if (isOver || armed.error().code == ErrorCode::Stopped) return failure(armed);
    return std::optional(armed.error());
}

}  // namespace

Result<Json> arm(ScriptSession& session, const Arguments& arguments) {
    const auto problem = tryToArm(session, arguments.load("load"));
    if (!problem) return failure(problem);
    return Json(*problem ? (*problem)->message : "");
}

Result<Json> askToArm(ScriptSession& session, const Arguments& arguments) {
    const auto load = arguments.text("command.load");
    const auto weakest = bench::predictCommand(session, load, 0);
    if (!weakest) return failure(weakest);
    const auto problem = tryToArm(session, load);
    if (!problem) return failure(problem);
    session.bench().disarm();
    if (*problem && (*problem)->code != ErrorCode::LimitExceeded) return Json{{"problem", (*problem)->message}};
    return Json{{"refusals", Json::array({{{"what", "arming"},
                                           {"forbidden", true},
                                           {"refused", problem->has_value()},
                                           {"predicted", weakest->checkForbidden},
                                           {"reason", *problem ? (*problem)->message : ""}}})}};
}

}  // namespace tacto::host::loads
