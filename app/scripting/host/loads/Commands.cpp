// The commands of a check on a load, weakest first, as bench.predict() describes them.
#include "app/scripting/host/bench/Prediction.h"
#include "app/scripting/host/loads/LoadsObject.h"

namespace tacto::host::loads {

namespace {

Result<std::vector<bench::PredictedCommand>> predicted(ScriptSession& session, const Arguments& arguments) {
    const int count = arguments.whole("count");
    std::vector<bench::PredictedCommand> all;
    for (int i = 0; i < count; ++i) {
        auto command = bench::predictCommand(session, arguments.text("load"), static_cast<double>(i) / (count - 1));
        if (!command) return failure(command);
        all.push_back(std::move(*command));
    }
    return all;
}

}  // namespace

Result<Json> commands(ScriptSession& session, const Arguments& arguments) {
    const auto all = predicted(session, arguments);
    if (!all) return failure(all);
    Json out = Json::array();
    for (const auto& command : *all) out.push_back(toJson(command));
    return out;
}

Result<Json> strongest(ScriptSession& session, const Arguments& arguments) {
    const auto all = predicted(session, arguments);
    if (!all) return failure(all);
    for (auto command = all->rbegin(); command != all->rend(); ++command) {
        if (command->mayBeGiven()) return toJson(*command);
    }
    return Json();
}

}  // namespace tacto::host::loads
