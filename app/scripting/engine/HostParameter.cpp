#include "app/scripting/engine/HostParameter.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/base/JsonText.h"

namespace tacto {

namespace {

bool isOfType(const nlohmann::json& value, ValueType type) {
    switch (type) {
        case ValueType::Number:
            return value.is_number() && std::isfinite(value.get<double>());
        case ValueType::Whole:
            return value.is_number() && value.get<double>() == std::floor(value.get<double>());
        case ValueType::Text:
            return value.is_string();
        case ValueType::Flag:
            return value.is_boolean();
        case ValueType::List:
            return value.is_array();
        case ValueType::Object:
            return value.is_object();
        case ValueType::Load:
            return value.is_string() || (isOfType(value, ValueType::Number) && value.get<double>() > 0);
        case ValueType::Any:
            return true;
    }
    return false;
}

std::string oneOfWords(const std::vector<std::string_view>& words) {
    std::string out;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) out += i + 1 < words.size() ? ", " : " or ";
        out += fmt::format("\"{}\"", words[i]);
    }
    return out;
}

std::string typeWords(const HostParameter& parameter) {
    switch (parameter.type) {
        case ValueType::Number:
        case ValueType::Whole:
            return parameter.numbers.text();
        case ValueType::Text:
            if (!parameter.words.empty()) return oneOfWords(parameter.words);
            return parameter.mostCharacters == 0
                       ? "a text"
                       : fmt::format("a text of at most {} characters", parameter.mostCharacters);
        case ValueType::Flag:
            return "true or false";
        case ValueType::List:
            return parameter.items == ValueType::Text     ? "a list of texts"
                   : parameter.items == ValueType::Object ? "a list of objects"
                                                          : "a list";
        case ValueType::Object:
            return "an object";
        case ValueType::Load:
            return "ohms above 0, or a text such as \"200 ohm + 10 kohm || 50 nF\"";
        case ValueType::Any:
            return "any value";
    }
    return {};
}

}  // namespace

std::string HostParameter::accepted() const { return typeWords(*this) + (mayBeNull ? " or null" : ""); }

bool HostParameter::accepts(const nlohmann::json& value) const {
    if (mayBeNull && (value.is_null() || (value.is_number() && std::isnan(value.get<double>())))) return true;
    if (!isOfType(value, type)) return false;
    switch (type) {
        case ValueType::Number:
        case ValueType::Whole:
            return numbers.contain(value.get<double>());
        case ValueType::Text:
            if (!words.empty()) return std::find(words.begin(), words.end(), value.get<std::string>()) != words.end();
            if (mostCharacters > 0 && value.get_ref<const std::string&>().size() > mostCharacters) return false;
            return mayBeEmpty || mayBeLeftOut || !value.get_ref<const std::string&>().empty();
        case ValueType::List:
            return std::all_of(value.begin(), value.end(), [this](const auto& item) { return isOfType(item, items); });
        default:
            return true;
    }
}

std::string HostParameter::defaultText() const {
    if (!usualText.empty()) return std::string(usualText);
    if (usual.is_null()) return {};
    const auto value = usual.is_number()   ? fmt::format("{}", usual.get<double>())
                       : usual.is_string() ? fmt::format("\"{}\"", usual.get<std::string>())
                                           : dumpJson(usual);
    return unit.empty() || !usual.is_number() ? value : fmt::format("{} {}", value, unit);
}

HostParameter HostParameter::range(double from, double to) const {
    auto out = *this;
    out.numbers.low = from;
    out.numbers.high = to;
    return out;
}

HostParameter HostParameter::atLeast(double from) const {
    auto out = *this;
    out.numbers.low = from;
    return out;
}

HostParameter HostParameter::above(double from) const {
    auto out = atLeast(from);
    out.numbers.openLow = true;
    return out;
}

HostParameter HostParameter::of(ValueType elements) const {
    auto out = *this;
    out.items = elements;
    return out;
}

HostParameter HostParameter::oneOf(std::vector<std::string_view> accepted) const {
    auto out = *this;
    out.words = std::move(accepted);
    return out;
}

HostParameter HostParameter::atMost(std::size_t characters) const {
    auto out = *this;
    out.mostCharacters = characters;
    return out;
}

HostParameter HostParameter::orEmpty() const {
    auto out = *this;
    out.mayBeEmpty = true;
    return out;
}

HostParameter HostParameter::orNull() const {
    auto out = *this;
    out.mayBeNull = true;
    return out;
}

HostParameter HostParameter::otherwise(nlohmann::json value) const {
    auto out = optional();
    out.usual = std::move(value);
    return out;
}

HostParameter HostParameter::optional(std::string_view whereLeftOut) const {
    auto out = *this;
    out.mayBeLeftOut = true;
    out.usualText = whereLeftOut;
    return out;
}

namespace takes {

HostParameter number(std::string_view name, std::string_view unit, std::string_view about) {
    return {.name = name, .type = ValueType::Number, .unit = unit, .about = about};
}
HostParameter whole(std::string_view name, std::string_view about) {
    return {.name = name, .type = ValueType::Whole, .about = about, .numbers = {.whole = true}};
}
HostParameter text(std::string_view name, std::string_view about) {
    return {.name = name, .type = ValueType::Text, .about = about};
}
HostParameter flag(std::string_view name, std::string_view about) {
    return {.name = name, .type = ValueType::Flag, .about = about};
}
HostParameter list(std::string_view name, std::string_view about) {
    return {.name = name, .type = ValueType::List, .about = about};
}
HostParameter object(std::string_view name, std::string_view about) {
    return {.name = name, .type = ValueType::Object, .about = about};
}
HostParameter load(std::string_view name, std::string_view about) {
    return {.name = name, .type = ValueType::Load, .unit = "ohm", .about = about};
}
HostParameter any(std::string_view name, std::string_view about) { return {.name = name, .about = about}; }

}  // namespace takes

}  // namespace tacto
