// Decides whether conditions can be told apart.
#include <cmath>
#include <set>
#include <string>

#include "app/scripting/host/analysis/RunAnalysis.h"
#include "core/analysis/drift/Drift.h"
#include "core/analysis/separability/SeparabilityJson.h"
#include "core/results/ResultRecord.h"

namespace tacto::host::analysis {

namespace {

// Computing may take only a moment, because a stop cannot interrupt it.
constexpr std::size_t kMaxTrials = 20'000, kMaxConditions = 64;

Result<std::vector<SeparabilityTrial>> trialsFrom(const Arguments& arguments, const Json& rows) {
    std::vector<SeparabilityTrial> trials;
    std::set<std::string> names;
    for (const auto& row : rows) {
        auto trial = separabilityTrialFrom(row);
        if (!trial) return arguments.wrong("a trial", row, "an object with a condition, from record.trials(),");
        names.insert(trial->condition);
        trials.push_back(std::move(*trial));
    }
    if (trials.size() > kMaxTrials || names.size() > kMaxConditions) {
        return arguments.wrong("the list of trials", fmt::format("{} of {} conditions", trials.size(), names.size()),
                               fmt::format("one of at most {} of {}", kMaxTrials, kMaxConditions));
    }
    return trials;
}

}  // namespace

Result<Separability> separabilityOf(const Arguments& arguments, const Json& rows, std::vector<std::string> conditions) {
    const auto trials = trialsFrom(arguments, rows);
    if (!trials) return failure(trials);
    return judgeSeparability(*trials, {.conditions = std::move(conditions)});
}

namespace {

Result<Json> separability(ScriptSession&, const Arguments& arguments) {
    const auto trials = trialsFrom(arguments, arguments.list("trials"));
    if (!trials) return failure(trials);
    const auto found = judgeSeparability(*trials, {.conditions = arguments.list("options.conditions")});
    if (!found) return failure(found);
    Json out = toJson(*found);
    out["trials"] = resultJson(*trials);
    return out;
}

Result<Json> drift(ScriptSession&, const Arguments& arguments) {
    const auto trials = trialsFrom(arguments, arguments.list("trials"));
    if (!trials) return failure(trials);
    const auto found = judgeDrift(*trials, {.tolerance_pct = arguments.number("options.tolerance_pct")});
    if (!found) return failure(found);
    return toJson(*found);
}

}  // namespace

}  // namespace tacto::host::analysis

namespace tacto {

std::vector<HostFunction> separabilityAnalysis() {
    using namespace takes;
    return {
        {.name = "separability",
         .parameters =
             {list("trials",
                   "objects with condition, amplitude_v, interval_s, and their uncertainties amplitude_u_v, "
                   "interval_u_s, time_base_u, without which the verdict cannot be a pass, and amplitude_gain_u, the "
                   "part of amplitude_u_v that all trials share; from record.trials()"),
              list("options.conditions", "names that must all be there, else the verdict cannot be a pass")
                  .of(ValueType::Text)
                  .optional()},
         .text = "Judges whether the conditions can be told apart from what was measured.",
         .members = separabilityKind().members,
         .returns = " with kind and trials, for plot.* and verdict().",
         .errors = "Throws for fewer than two conditions, or a value that is not above zero.",
         .call = host::analysis::separability},
        {.name = "drift",
         .parameters = {list("trials", "as analysis.separability() takes them, in the order in which they were made"),
                        number("options.tolerance_pct", "%", "the largest change that is accepted")
                            .range(0.01, 100)
                            .otherwise(DriftOptions{}.tolerance_pct)},
         .text = "Judges whether the amplitude stayed where it was over the trials: along a straight line, and from "
                 "one quarter of them to another.",
         .members = driftKind().members,
         .returns = " with kind, for plot.curves() (its curves) and verdict().",
         .errors = "Throws for no trials, or an amplitude that is not above zero.",
         .call = host::analysis::drift},
    };
}

}  // namespace tacto
