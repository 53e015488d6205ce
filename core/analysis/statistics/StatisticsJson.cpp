#include "core/analysis/statistics/StatisticsJson.h"

namespace tacto {

using nlohmann::json;

json toJson(const Statistics& s) {
    return {{"mean", numberOrNull(s.mean)}, {"sd", numberOrNull(s.sd)},   {"median", numberOrNull(s.median)},
            {"min", numberOrNull(s.min)},   {"max", numberOrNull(s.max)}, {"n", s.n}};
}

json toJson(const Estimate& e) {
    return {{"value", numberOrNull(e.value)}, {"low", numberOrNull(e.low)}, {"high", numberOrNull(e.high)}};
}

}  // namespace tacto
