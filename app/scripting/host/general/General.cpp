// Functions without a bench: declaration, progress, verdict and log.
#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptSession.h"

namespace tacto::host::general {

namespace {

using Json = nlohmann::json;

Result<Json> progress(ScriptSession& session, const Arguments& arguments) {
    const Json& label = arguments.any("label");
    session.progress({label.is_string() ? label.get<std::string>() : "",
                      static_cast<std::size_t>(arguments.whole("the position")),
                      static_cast<std::size_t>(arguments.whole("the list's length"))});
    return Json();
}

Result<Json> verdict(ScriptSession& session, const Arguments& arguments) {
    const Json& found = arguments.object("found");
    const Json name = found.value("verdict", Json());
    ScriptVerdict verdict = ScriptVerdict::None;
    for (const auto known : {ScriptVerdict::Pass, ScriptVerdict::Fail, ScriptVerdict::Indeterminate}) {
        if (name == nameOf(known)) verdict = known;
    }
    std::vector<std::string> reasons;
    const Json given = found.value("reasons", Json::array());
    for (const auto& reason : given) {
        if (reason.is_string()) reasons.push_back(reason.get<std::string>());
    }
    session.judge(verdict, std::move(reasons), found);
    return name;
}

Result<Json> log(ScriptSession& session, const Arguments& arguments) {
    std::string line;
    for (const auto& value : arguments.all()) {
        if (!line.empty()) line += ' ';
        line += value.is_string() ? value.get<std::string>() : shown(value);
    }
    session.log(line);
    return Json();
}

Result<Json> protocol(ScriptSession&, const Arguments&) { return Json(); }  // the declaration was read earlier

}  // namespace

}  // namespace tacto::host::general

namespace tacto {

std::vector<HostFunction> generalFunctions() {
    using namespace takes;
    return {
        {.name = "protocol",
         .parameters = {object(
             "declaration",
             "{ title, purpose, kind, needs: [\"sensor\", \"stimulator\", \"oscilloscope\", \"massager\"], parameters: "
             "{ "
             "NAME: { label, type: number | integer | choice | text | boolean | date | file, unit, min, max, option, "
             "choices, value, step: \"reference\", needed, zero } } }")},
         .text =
             "Declares what the script is and what it takes. Once, at top level. `step`: the parameter is of the "
             "known reference that is read first. `needed`: what is not known without it; 0 or nothing is no "
             "answer then, and the window asks for it before a run. `zero`: what 0 stands for, \"from the profile\". "
             "`option`: the option of a host function whose unit and range the number has, in place of unit, min and "
             "max: \"analysis.variation.detection_ma\".",
         .errors = "Throws for a key, type, role or range that does not fit.",
         .call = host::general::protocol,
         .javascript =  // JavaScript objects keep the order in which they were written; JSON does not.
         R"js((declaration) => {
            const keys = (x) => x !== null && typeof x === "object" && !Array.isArray(x) ? Object.keys(x) : [];
            const parameters = declaration && declaration.parameters, names = keys(parameters), choices = [];
            for (let i = 0; i < names.length; ++i) {
                choices[i] = keys(parameters[names[i]] && parameters[names[i]].choices);
            }
            native(declaration, names, choices);
         })js"},
        {.name = "progress",
         .parameters = {list("list", "what to go through"), text("label", "what the progress bar says").optional()},
         .text = "Goes through a list in a for...of loop and shows how far it is.",
         .returns = "What for...of takes.",
         .call = host::general::progress,
         .javascript =  // Written by hand, because a frozen generator's objects do not iterate in this engine.
         R"js((list, label) => {
            const total = list && list.length, done = { value: undefined, done: true };
            native(0, total, label);
            let next = 0;
            const step = () => {
                if (next >= total) return done;
                const value = list[next];
                if (next > 0) native(next, total, label);
                next += 1;
                return { value: value, done: false };
            };
            const end = () => { native(total, total, label); return done; };
            return { [Symbol.iterator]: () => ({ next: () => (next < total ? step() : end()), return: () => done }) };
         })js",
         .passes = {whole("the position", "").range(0, 1e9), whole("the list's length", "").range(0, 1e9),
                    any("label", "")}},
        {.name = "verdict",
         .parameters = {object("found", "an analysis' result: { verdict, reasons, ... }"),
                        text("found.verdict", "its verdict").oneOf({"pass", "fail", "indeterminate"}).orNull()},
         .text = "Makes the run's verdict and results. The last one counts.",
         .returns = "The verdict.",
         .call = host::general::verdict},
        {.name = "log",
         .parameters = {any("values", "one or more")},
         .text = "Writes a line to the run's log.",
         .call = host::general::log},
    };
}

}  // namespace tacto
