// Whether conditions can be told apart.
#include <cmath>
#include <set>
#include <string>

#include "app/scripting/host/analysis/AnalysisObject.h"
#include "core/analysis/separability/SeparabilityJson.h"
#include "core/analysis/statistics/StatisticsJson.h"

namespace tacto::host::analysis {

namespace {

// No more than a moment of computing: a stop does not wait for it.
constexpr std::size_t kMaxTrials = 20'000, kMaxConditions = 64;

}  // namespace

Result<Json> separability(ScriptSession&, const Arguments& arguments) {
    const Json& rows = arguments.list("trials");
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
    options.conditions = arguments.list("options.conditions").get<std::vector<std::string>>();
    auto found = judgeSeparability(trials, options);
    if (!found) return failure(found);
    Json out = toJson(*found);
    out["trials"] = features;
    return out;
}

}  // namespace tacto::host::analysis
