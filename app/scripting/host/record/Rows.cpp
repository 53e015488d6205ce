// Records trials, measurements and events, and keeps partial results of a run that ends early.
#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptSession.h"

namespace tacto::host::record {

namespace {

using Json = nlohmann::json;

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
    // Measurements with these names hold what the program found; a script cannot write them (hazard H9).
    if (name == kExposureMeasurement || name == kCalibrationMeasurement)
        return arguments.wrong("name", name, "a name that the program does not use itself");
    return done(session.keepMeasurement(name, values));
}

Result<Json> event(ScriptSession& session, const Arguments& arguments) {
    return done(session.keepEvent(arguments.text("kind"), arguments.any("details")));
}

Result<Json> partial(ScriptSession& session, const Arguments& arguments) {
    const Json& found = arguments.object("found");
    const Json& tables = arguments.list("tables");
    for (const auto& table : tables) {
        if (!table.value("caption", Json()).is_string() || !table.value("rows", Json()).is_array())
            return arguments.wrong("a table", table, "an object with a caption and a list of rows");
    }
    session.keepPartial(found, tables);
    return Json();
}

}  // namespace

}  // namespace tacto::host::record

namespace tacto {

std::vector<HostFunction> rowFunctions() {
    using namespace takes;
    return {
        {.name = "trial",
         .parameters = {text("condition", "name of the condition presented"),
                        object("measured", "from measure.train(), or any values with their units in the names")},
         .text = "Records a trial and the captures it was measured on.",
         .returns = "The trial's number, from 1.",
         .errors = "Throws when the session file cannot be written.",
         .call = host::record::trial},
        {.name = "trials",
         .text = "Every trial recorded so far.",
         .returns = "List of { condition, trial, and what was measured }.",
         .call = host::record::trials},
        {.name = "measurement",
         .parameters = {text("name", "what was measured"), object("values", "values with their units in the names")},
         .text = "Records a measured or calibrated value.",
         .errors = "Throws when the session file cannot be written.",
         .call = host::record::measurement},
        {.name = "event",
         .parameters = {text("kind", "what happened, in a word or two"),
                        any("details", "anything worth keeping").optional()},
         .text = "Records that something happened, as the event \"script: KIND\".",
         .errors = "Throws when the session file cannot be written.",
         .call = host::record::event},
        {.name = "partial",
         .parameters = {object("found", "results so far, as verdict() takes them"),
                        list("tables", "{ caption, rows, columns }, for the report; kind is \"table\" or \"matrix\"")
                            .of(ValueType::Object)
                            .optional("those of the results' kind alone")},
         .text = "Keeps what a run has come to, in case it ends early: results and tables then say that they are "
                 "partial. The last one counts; a run that ends by itself uses none.",
         .call = host::record::partial},
    };
}

}  // namespace tacto
