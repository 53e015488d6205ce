#include "core/base/JsonFields.h"

#include <cmath>
#include <limits>

namespace tacto {

namespace {

const nlohmann::json* find(const nlohmann::json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

}  // namespace

std::string textOr(const nlohmann::json& object, const char* key) {
    const auto* found = find(object, key);
    return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

nlohmann::json numberOrNull(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

double numberOr(const nlohmann::json& value) {
    return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

double numberOr(const nlohmann::json& object, const char* key) {
    const auto* found = find(object, key);
    return found != nullptr ? numberOr(*found) : std::numeric_limits<double>::quiet_NaN();
}

std::uint64_t countOr(const nlohmann::json& object, const char* key) {
    const auto* found = find(object, key);
    return found != nullptr && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
}

bool flagOr(const nlohmann::json& object, const char* key) {
    const auto* found = find(object, key);
    return found != nullptr && found->is_boolean() && found->get<bool>();
}

std::vector<std::string> textsOr(const nlohmann::json& object, const char* key) {
    std::vector<std::string> texts;
    const auto* found = find(object, key);
    if (found == nullptr || !found->is_array()) return texts;
    for (const auto& each : *found) texts.push_back(each.is_string() ? each.get<std::string>() : std::string());
    return texts;
}

nlohmann::json valueOr(const nlohmann::json& object, const char* key) {
    const auto* found = find(object, key);
    return found != nullptr ? *found : nlohmann::json();
}

}  // namespace tacto
