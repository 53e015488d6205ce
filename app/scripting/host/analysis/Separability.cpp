// Whether conditions can be told apart.
#include <cmath>
#include <set>
#include <string>

#include "app/scripting/host/analysis/RunAnalysis.h"
#include "core/analysis/separability/SeparabilityJson.h"
#include "core/analysis/statistics/StatisticsJson.h"

namespace tacto::host::analysis {

namespace {

// No more than a moment of computing: a stop does not wait for it.
constexpr std::size_t kMaxTrials = 20'000, kMaxConditions = 64;

}  // namespace

Result<Json> separabilityOf(const Arguments& arguments, const Json& rows, std::vector<std::string> conditions) {
    std::vector<SeparabilityTrial> trials;
    Json features = Json::array();
    for (const auto& row : rows) {
        auto trial = separabilityTrialFrom(row);
        if (!trial) return arguments.wrong("a trial", row, "an object with a condition, from record.trials(),");
        features.push_back(toJson(*trial));
        trials.push_back(std::move(*trial));
    }
    std::set<std::string> names;
    for (const auto& trial : trials) names.insert(trial.condition);
    if (trials.size() > kMaxTrials || names.size() > kMaxConditions) {
        return arguments.wrong("the list of trials", fmt::format("{} of {} conditions", trials.size(), names.size()),
                               fmt::format("one of at most {} of {}", kMaxTrials, kMaxConditions));
    }
    SeparabilityOptions options;
    options.conditions = std::move(conditions);
    auto found = judgeSeparability(trials, options);
    if (!found) return failure(found);
    Json out = toJson(*found);
    out["trials"] = features;
    return out;
}

namespace {

Result<Json> separability(ScriptSession&, const Arguments& arguments) {
    return separabilityOf(arguments, arguments.list("trials"), arguments.list("options.conditions"));
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
         .returns =
             "{ verdict, reasons, conditions, pairs, confusion, accuracy, folds, trials }, for plot.* and verdict().",
         .errors = "Throws for fewer than two conditions, or a value that is not above zero.",
         .call = host::analysis::separability},
    };
}

}  // namespace tacto
