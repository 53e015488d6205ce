// ResultText.h - what a protocol's results say under a key, for the tables of the command line.
//
// Thread-safety: pure functions.
#pragma once

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/base/QuantityText.h"

namespace tacto::cli {

/// NaN where there is no number of that name.
[[nodiscard]] inline double resultValue(const nlohmann::json& object, const char* key) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    return found != object.end() && found->is_number() ? found->get<double>() : NAN;
}

/// Empty where there is none of that name.
[[nodiscard]] inline nlohmann::json resultObject(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_object() ? *found : nlohmann::json::object();
}
[[nodiscard]] inline nlohmann::json resultList(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_array() ? *found : nlohmann::json::array();
}

/// Empty where there is no text of that name.
[[nodiscard]] inline std::string resultText(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// "–" where there is no number of that name.
[[nodiscard]] inline std::string resultNumber(const nlohmann::json& object, const char* key, double factor = 1) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number()) return "–";
    const auto value = factor * found->get<double>();
    return std::abs(value) >= 1000 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

/// With its unit, scaled: "8.705 pC" of 8.705e-6 µC; "–" where there is no number of that name.
[[nodiscard]] inline std::string resultQuantity(const nlohmann::json& object, const char* key, std::string_view unit,
                                                int digits = 4) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? scaledText(found->get<double>(), unit, digits) : "–";
}

}  // namespace tacto::cli
