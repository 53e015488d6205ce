#include "core/analysis/separability/SeparabilityJson.h"

#include "core/analysis/statistics/StatisticsJson.h"

namespace tacto {

using nlohmann::json;

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

}  // namespace tacto
