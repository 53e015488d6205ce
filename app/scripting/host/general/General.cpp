// Functions without a bench: declaring, progress, the verdict, the log.
#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/general/GeneralObject.h"

namespace tacto::host::general {

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

Result<Json> protocol(ScriptSession&, const Arguments&) { return Json(); }  // read when the script was declared

}  // namespace tacto::host::general
