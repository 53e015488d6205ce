// Trials, measurements and events, and what is kept of a run that ends early.
#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/record/RecordObject.h"
#include "app/scripting/host/report/LoadSafetyTables.h"
#include "core/results/ResultKind.h"
#include "core/session/SessionWriter.h"

namespace tacto::host::record {

Result<Json> trial(ScriptSession& session, const Arguments& arguments) {
    const auto condition = arguments.text("condition");
    const Json& measured = arguments.object("measured");
    auto number = session.addTrial(condition, measured);
    if (!number) return failure(number);
    return Json(*number);
}

Result<Json> trials(ScriptSession& session, const Arguments&) { return Json(session.trials()); }

Result<Json> measurement(ScriptSession& session, const Arguments& arguments) {
    const auto name = arguments.text("name");
    const Json& values = arguments.object("values");
    // These names hold what the program found, not what a script says (hazard H9).
    if (name == kExposureMeasurement || name == kCalibrationMeasurement)
        return arguments.wrong("name", name, "a name that the program does not use itself");
    if (session.writer() == nullptr) return Json();
    return done(session.writer()->measurement(session.now(), name, values));
}

Result<Json> event(ScriptSession& session, const Arguments& arguments) {
    const auto kind = arguments.text("kind");
    if (session.writer() == nullptr) return Json();
    // No event of the program begins like this: "script not started" is one of its own (hazard H9).
    return done(session.writer()->event(session.now(), "script: " + kind, arguments.any("details")));
}

Result<Json> partial(ScriptSession& session, const Arguments& arguments) {
    const Json& found = arguments.object("found");
    const bool checksLoads = resultTraits(session.kindOf(found)).kind == ResultKind::LoadSafety;
    const Json tables =
        !arguments.has("tables") && checksLoads ? report::loadSafetyTables(found) : arguments.list("tables");
    for (const auto& table : tables) {
        if (!table.value("caption", Json()).is_string() || !table.value("rows", Json()).is_array())
            return arguments.wrong("a table", table, "an object with a caption and a list of rows");
    }
    session.keepPartial(found, tables);
    return Json();
}

}  // namespace tacto::host::record
