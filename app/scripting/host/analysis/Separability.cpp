// Whether conditions can be told apart.
#include <cmath>

#include "app/scripting/host/analysis/AnalysisObject.h"
#include "core/analysis/separability/SeparabilityJson.h"
#include "core/analysis/statistics/StatisticsJson.h"

namespace tacto::host::analysis {

Result<Json> separability(ScriptSession&, const Arguments& arguments) {
    const Json& rows = arguments.list("trials");
    std::vector<SeparabilityTrial> trials;
    Json features = Json::array();
    for (const auto& row : rows) {
        if (!row.is_object() || !row.value("condition", Json()).is_string()) {
            return arguments.wrong("a trial", row, "an object with a condition, from record.trials(),");
        }
        SeparabilityTrial trial;
        trial.condition = row["condition"].get<std::string>();
        trial.amplitude = numberOr(row, "amplitude_v");
        trial.interval_s = numberOr(row, "interval_s");
        trial.amplitudeUncertainty = numberOr(row, "amplitude_u_v");
        trial.intervalUncertainty_s = numberOr(row, "interval_u_s");
        trial.timeBase = numberOr(row, "time_base_u");
        features.push_back({{"condition", trial.condition},
                            {"amplitude_v", numberOrNull(trial.amplitude)},
                            {"interval_s", numberOrNull(trial.interval_s)},
                            {"amplitude_u_v", numberOrNull(trial.amplitudeUncertainty)},
                            {"interval_u_s", numberOrNull(trial.intervalUncertainty_s)},
                            {"time_base_u", numberOrNull(trial.timeBase)}});
        trials.push_back(std::move(trial));
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
