// A pilot session's beginning and end, and what protects the participant around its trials.
#include "app/scripting/host/pilot/PilotObject.h"

namespace tacto::host::pilot {

Result<Json> begin(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) { return pilot.begin(arguments.flag("options.trials")); });
}

Result<Json> skin(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) { return pilot.care().skin(arguments.text("moment")); });
}

Result<Json> sideEffects(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) { return pilot.care().sideEffects(arguments.text("moment")); });
}

Result<Json> ratings(ScriptSession& session, const Arguments&) {
    return inPilot(session,
                   [](PilotSession& pilot) { return pilot.care().ratings(pilot.identification().presented()); });
}

Result<Json> finish(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session,
                   [&](PilotSession& pilot) { return pilot.stage().end(PilotEnd::Complete, arguments.text("why")); });
}

namespace {

Result<Json> resultsOf(PilotSession& pilot, bool identification) {
    Json found;
    std::string said;
    if (identification) {
        auto all = pilot.identificationResults();
        if (!all) return failure(all);
        auto headline = pilot.headlineText();
        if (!headline) return failure(headline);
        found = std::move(*all);
        said = std::move(*headline);
    } else {
        found = pilot.thresholdResults();
    }
    found["verdict"] = nullptr;
    found["reasons"] = Json::array();
    const auto& range = pilot.thresholds().found();
    if (range && !range->usable) {
        found["verdict"] = "indeterminate";
        found["reasons"].push_back("No usable range: " + range->reason);
    }
    if (!said.empty()) {
        found["headline"] = said;
        found["reasons"].push_back(said);
    }
    return found;
}

}  // namespace

Result<Json> results(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session,
                   [&](PilotSession& pilot) { return resultsOf(pilot, arguments.text("of") == "identification"); });
}

Result<Json> blocks(ScriptSession& session, const Arguments&) {
    return inPilot(session, [](PilotSession& pilot) -> Result<Json> {
        Json all = Json::array();
        for (int block = 1; block <= pilot.stage().settings().blocks; ++block) all.push_back(block);
        return all;
    });
}

}  // namespace tacto::host::pilot
