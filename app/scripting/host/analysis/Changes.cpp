// Captured steps and movements, judged name by name.
#include "app/scripting/host/analysis/AnalysisObject.h"
#include "core/analysis/transitions/TransitionsJson.h"
#include "core/encoding/Transitions.h"

namespace tacto::host::analysis {

namespace {

std::vector<std::string> namesAsked(const Arguments& arguments) { return arguments.list("options.names"); }

bool isNamed(const Json& row) { return row.value("name", Json()).is_string(); }

}  // namespace

Result<Json> latency(ScriptSession&, const Arguments& arguments) {
    std::vector<StepLatency> steps;
    for (const auto& row : arguments.list("steps")) {
        if (!isNamed(row)) return arguments.wrong("a step", row, "what bench.step() returned, with a name,");
        steps.push_back(stepLatencyFrom(row));
    }
    return toJson(judgeLatency(steps, namesAsked(arguments), arguments.number("options.tolerance_s")));
}

Result<Json> changes(ScriptSession&, const Arguments& arguments) {
    std::vector<CapturedChange> changes;
    for (const auto& row : arguments.list("changes")) {
        if (!isNamed(row) || !row.value("onsets", Json()).is_array())
            return arguments.wrong("a change", row, "what bench.step() or bench.traverse() returned, with a name,");
        changes.push_back(capturedChangeFrom(row));
    }
    const ChangeLimits limits{kWantedPerTrain, arguments.number("options.complete_s"),
                              arguments.flag("options.seconds_alone")};
    return toJson(judgeChanges(changes, namesAsked(arguments), limits));
}

}  // namespace tacto::host::analysis
