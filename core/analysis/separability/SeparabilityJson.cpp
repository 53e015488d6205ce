#include "core/analysis/separability/SeparabilityJson.h"

#include <cmath>
#include <limits>

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/Csv.h"
#include "core/base/RecordFields.h"
#include "core/base/Statistics.h"
#include "core/base/Text.h"

namespace tacto {

using nlohmann::json;

namespace {

const RecordFields<SeparabilityTrial>& trialFields() {
    static const auto fields = [] {
        using T = SeparabilityTrial;
        RecordFields<T> all;
        all.text("condition", &T::condition, {.mayBeEmpty = true}).required = true;
        all.number("amplitude_v", &T::amplitude, {.unit = "V"});
        all.number("interval_s", &T::interval_s, {.unit = "s"});
        all.number("amplitude_u_v", &T::amplitudeUncertainty, {.unit = "V"});
        all.number("interval_u_s", &T::intervalUncertainty_s, {.unit = "s"});
        all.number("time_base_u", &T::timeBase);
        all.number("amplitude_gain_u", &T::amplitudeGain);
        all.takeNullAsMissing();
        all.passOverUnknownKeys();
        return all;
    }();
    return fields;
}

}  // namespace

Result<SeparabilityTrial> separabilityTrialFrom(const json& row) {
    SeparabilityTrial trial{{}, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN};
    if (auto read = trialFields().read(row, trial, {.path = "trial"}).map_error(asInvalidArgument); !read)
        return failure(read);
    return trial;
}

json toJson(const SeparabilityTrial& trial) { return trialFields().write(trial); }

json toJson(const Separability& found) {
    json conditions = json::array();
    for (const auto& c : found.conditions) {
        conditions.push_back({{"name", c.name},
                              {"n", c.n},
                              {"not_measured", c.notMeasured},
                              {"amplitude_v", toJson(c.amplitude)},
                              {"interval_s", toJson(c.interval_s)},
                              {"amplitude_variation", numberOrNull(c.amplitudeVariation)},
                              {"interval_variation", numberOrNull(c.intervalVariation)},
                              {"amplitude_variation_low", numberOrNull(c.amplitudeVariationBounds.low)},
                              {"amplitude_variation_high", numberOrNull(c.amplitudeVariationBounds.high)},
                              {"interval_variation_low", numberOrNull(c.intervalVariationBounds.low)},
                              {"interval_variation_high", numberOrNull(c.intervalVariationBounds.high)}});
    }
    json pairs = json::array();
    for (const auto& p : found.pairs) {
        pairs.push_back({{"a", p.a},
                         {"b", p.b},
                         {"mahalanobis", numberOrNull(p.mahalanobis)},
                         {"amplitude_jnd", numberOrNull(p.amplitudeJnd)},
                         {"interval_jnd", numberOrNull(p.intervalJnd)},
                         {"amplitude_jnd_low", numberOrNull(p.amplitudeJndBounds.low)},
                         {"amplitude_jnd_high", numberOrNull(p.amplitudeJndBounds.high)},
                         {"interval_jnd_low", numberOrNull(p.intervalJndBounds.low)},
                         {"interval_jnd_high", numberOrNull(p.intervalJndBounds.high)}});
    }
    return {
        {"kind", "separability"},
        {"conditions", conditions},
        {"pairs", pairs},
        {"confusion", found.confusion},
        {"accuracy", toJson(found.accuracy)},
        {"floor",
         {{"amplitude_v", numberOrNull(found.amplitudeFloor)}, {"interval_s", numberOrNull(found.intervalFloor_s)}}},
        {"folds", found.folds},
        {"verdict", nameOf(found.verdict)},
        {"reasons", found.reasons}};
}

Result<std::vector<SeparabilityTrial>> readSeparabilityTrials(const std::filesystem::path& path) {
    const auto text = readTextFile(path);
    if (!text) return failure(text);
    return parseSeparabilityTrials(*text, path.string());
}

Result<std::vector<SeparabilityTrial>> parseSeparabilityTrials(std::string_view text, std::string_view name) {
    NamedRows rows(text, name, "columns condition, amplitude and interval were expected", "a row per trial");
    const auto condition = rows.column({"condition"});
    if (!condition) return failure(condition);
    const auto amplitude = rows.column({"amplitude", "amplitude_v", "amplitude_ma"});
    if (!amplitude) return failure(amplitude);
    const auto interval = rows.column({"interval", "interval_s"});
    if (!interval) return failure(interval);

    std::vector<SeparabilityTrial> trials;
    auto more = rows.next();
    for (; more && *more; more = rows.next()) {
        SeparabilityTrial trial;
        trial.condition = std::string(rows[*condition]);
        if (trial.condition.empty()) return rows.refuse("the condition is empty; a name was expected");
        struct Value {
            std::string_view column;
            std::string_view field;
            double* target;
        };
        for (const auto& [column, field, target] : {Value{"amplitude", rows[*amplitude], &trial.amplitude},
                                                    Value{"interval", rows[*interval], &trial.interval_s}}) {
            if (field.empty()) {
                *target = std::numeric_limits<double>::quiet_NaN();
                continue;
            }
            const auto number = parseNumber(field);
            if (!number || !(std::isnan(*number) || (*number > 0 && std::isfinite(*number)))) {
                return rows.refuse(
                    "{} '{}'; a finite number above 0 was expected, or nothing where it was not measured", column,
                    field.substr(0, 40));
            }
            *target = *number;
        }
        trials.push_back(std::move(trial));
    }
    if (!more) return failure(more);
    return trials;
}

}  // namespace tacto
