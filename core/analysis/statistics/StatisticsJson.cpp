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

ValueKind<double> readingKind() {
    return codedKind<double>(
        "a number or null",
        [](const json& value) {
            return value.is_number() || value.is_null() ? std::optional(numberOr(value)) : std::nullopt;
        },
        [](double reading) { return numberOrNull(reading); });
}

ValueKind<std::string> textOrNullKind() {
    return codedKind<std::string>(
        "a text or null",
        [](const json& value) { return std::optional(value.is_string() ? value.get<std::string>() : ""); },
        [](const std::string& text) { return text.empty() ? json() : json(text); });
}

}  // namespace tacto
