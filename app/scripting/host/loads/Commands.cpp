// The commands of a check on a load, weakest first, as bench.predict() describes them.
#include "app/scripting/host/bench/Prediction.h"
#include "app/scripting/host/loads/LoadsObject.h"

namespace tacto::host::loads {

Result<Json> commands(ScriptSession& session, const Arguments& arguments) {
    const int count = arguments.whole("count");
    Json out = Json::array();
    for (int i = 0; i < count; ++i) {
        auto command = bench::predictCommand(session, arguments.text("load"), static_cast<double>(i) / (count - 1));
        if (!command) return command;
        out.push_back(std::move(*command));
    }
    return out;
}

Result<Json> strongest(ScriptSession& session, const Arguments& arguments) {
    const auto all = commands(session, arguments);
    if (!all) return all;
    for (auto command = all->rbegin(); command != all->rend(); ++command) {
        if (command->at("not_applicable").is_null() && !command->at("forbidden")) return *command;
    }
    return Json();
}

}  // namespace tacto::host::loads
