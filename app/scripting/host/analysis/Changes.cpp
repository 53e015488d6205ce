// Captured steps and movements, judged name by name.
#include "app/scripting/host/analysis/AnalysisObject.h"
#include "core/analysis/transitions/TransitionsJson.h"
#include "core/encoding/Transitions.h"

namespace tacto::host::analysis {

namespace {

Result<std::vector<CapturedChange>> changesIn(const Json& rows) {
    std::vector<CapturedChange> changes;
    for (const auto& row : rows) {
        auto change = capturedChangeFrom(row);
        if (!change) return failure(change);
        changes.push_back(std::move(*change));
    }
    return changes;
}

std::vector<std::string> namesAsked(const Arguments& arguments) { return arguments.list("options.names"); }

}  // namespace

Result<Json> latency(ScriptSession&, const Arguments& arguments) {
    const auto steps = changesIn(arguments.list("steps"));
    if (!steps) return failure(steps);
    return toJson(judgeLatency(*steps, namesAsked(arguments), arguments.number("options.tolerance_s")));
}

Result<Json> changes(ScriptSession&, const Arguments& arguments) {
    for (const auto& row : arguments.list("changes")) {
        if (!row.contains("onsets"))
            return arguments.wrong("a change", row, "what bench.step() or bench.traverse() returned, with a name,");
    }
    const auto changes = changesIn(arguments.list("changes"));
    if (!changes) return failure(changes);
    const ChangeLimits limits{kWantedPerTrain, arguments.number("options.complete_s"),
                              arguments.flag("options.seconds_alone")};
    return toJson(judgeChanges(*changes, namesAsked(arguments), limits));
}

}  // namespace tacto::host::analysis
