#include "app/scripting/engine/ProtocolParameter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/DeclaredText.h"
#include "app/scripting/engine/HostFunction.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Statistics.h"
#include "core/base/TypedNumber.h"
#include "core/base/ValueKind.h"
#include "core/base/Words.h"
#include "core/calibration/CalibrationStore.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

constexpr Word<ParameterType> kTypes[] = {{"number", ParameterType::Number},   {"integer", ParameterType::Integer},
                                          {"choice", ParameterType::Choice},   {"text", ParameterType::Text},
                                          {"boolean", ParameterType::Boolean}, {"date", ParameterType::Date},
                                          {"file", ParameterType::File}};
constexpr std::string_view kReferenceStep = "reference";

/// A double holds every whole number up to this number exactly, but not every larger number.
constexpr double kMaxWholeNumber = 9007199254740992;  // 2^53

/// Returns the parameter's range, limited to -`widest` to `widest`.
AcceptedNumbers rangeOf(const ProtocolParameter& parameter, double widest = std::numeric_limits<double>::max()) {
    return {.low = std::max(parameter.min.value_or(-widest), -widest),
            .high = std::min(parameter.max.value_or(widest), widest),
            .whole = parameter.type == ParameterType::Integer,
            .unit = parameter.unit};
}

std::string choicesText(const ProtocolParameter& parameter) {
    std::vector<std::string_view> keys;
    for (const auto& choice : parameter.choices) keys.push_back(choice.first);
    return fmt::format("one of {}", fmt::join(keys, ", "));
}

bool hasChoice(const ProtocolParameter& parameter, const std::string& key) {
    return std::any_of(parameter.choices.begin(), parameter.choices.end(),
                       [&](const auto& choice) { return choice.first == key; });
}

/// Returns the value in the form that the script takes, or an error that says what is accepted.
Result<Json> accepted(const ProtocolParameter& parameter, const Json& value) {
    const auto refuse = [&](const std::string& wanted) -> tl::unexpected<Error> {
        return fail(ErrorCode::InvalidArgument, "{} is {}, {} is expected", parameter.name,
                    value.is_string() ? value.get<std::string>() : shown(value), wanted);
    };
    switch (parameter.type) {
        case ParameterType::Number:
        case ParameterType::Integer: {
            const double x = value.is_number() ? value.get<double>() : kNaN;
            if (!rangeOf(parameter).contain(x)) return refuse(rangeOf(parameter).text());
            if (parameter.type == ParameterType::Number) return value;
            if (!(std::abs(x) <= kMaxWholeNumber)) return refuse(rangeOf(parameter, kMaxWholeNumber).text());
            return Json(static_cast<std::int64_t>(x));
        }
        case ParameterType::Choice:
            if (!value.is_string() || !hasChoice(parameter, value.get<std::string>())) {
                return refuse(choicesText(parameter));
            }
            return value;
        case ParameterType::Text:
            if (!value.is_string()) return refuse("a text");
            return value;
        case ParameterType::Date: {
            const auto* day = value.get_ptr<const std::string*>();
            if (day == nullptr || (!day->empty() && !parseDate(*day)))
                return refuse("a day such as 2027-03-01, or nothing,");
            return value;
        }
        case ParameterType::File:
            if (!value.is_string()) return refuse("the path of a file, or nothing,");
            return value;
        case ParameterType::Boolean:
            if (!value.is_boolean()) return refuse("true or false");
            return value;
    }
    return refuse("something else");
}

Result<ParameterType> typeOf(const Json& given, const std::string& name) {
    const auto at = given.find("type");
    if (at == given.end()) {
        if (given.contains("choices")) return ParameterType::Choice;
        const auto value = given.find("value");
        if (value != given.end() && value->is_boolean()) return ParameterType::Boolean;
        if (value != given.end() && value->is_string()) return ParameterType::Text;
        return ParameterType::Number;
    }
    const auto known = at->is_string() ? valueFor(kTypes, at->get_ref<const std::string&>()) : std::nullopt;
    if (known) return *known;
    return fail(ErrorCode::InvalidArgument, "parameter {}: type is {}, one of {} is expected", name, shown(*at),
                namesOf(kTypes));
}

Result<std::optional<double>> boundOf(const Json& given, const std::string& name, const char* key) {
    const auto at = given.find(key);
    if (at == given.end()) return std::optional<double>();
    if (!at->is_number() || !std::isfinite(at->get<double>())) {
        return fail(ErrorCode::InvalidArgument, "parameter {}: {} is {}, a number is expected", name, key, shown(*at));
    }
    return std::optional<double>(at->get<double>());
}

Result<void> readChoices(const Json& given, const Json& order, ProtocolParameter& out) {
    const Json choices = given.value("choices", Json());
    if (choices.is_array()) {
        for (const auto& key : choices) {
            if (key.is_string()) out.choices.emplace_back(key.get<std::string>(), key.get<std::string>());
        }
    }
    for (const auto& key : order) {
        if (!key.is_string() || !choices.is_object()) continue;
        const auto name = key.get<std::string>();
        const Json text = choices.value(name, Json());
        out.choices.emplace_back(name, text.is_string() ? text.get<std::string>() : name);
    }
    for (const auto& [key, text] : out.choices) {
        for (const auto& one : {key, text}) {
            if (const auto fits = noLongerThan("parameter " + out.name, "a choice", one, kMaxDeclaredText); !fits)
                return failure(fits);
        }
    }
    if (out.type == ParameterType::Choice && out.choices.size() < 2) {
        return fail(ErrorCode::InvalidArgument, "parameter {}: choices is {}, at least two are expected", out.name,
                    shown(choices));
    }
    if (out.type != ParameterType::Choice && !out.choices.empty()) {
        return fail(ErrorCode::InvalidArgument, "parameter {}: a {} has no choices", out.name, nameOf(out.type));
    }
    return {};
}

/// If the parameter stands for an option of a host function, it takes that option's unit and range.
Result<void> takeOption(const Json& given, const std::string& where, ProtocolParameter& out) {
    auto path = declaredText(given, where, "option", false, kMaxDeclaredTitle);
    if (!path) return failure(path);
    if (path->empty()) return {};
    for (const auto* own : {"unit", "min", "max"}) {
        if (given.contains(own))
            return fail(ErrorCode::InvalidArgument, "{}: {} is given, and the option {} has its own", where, own,
                        *path);
    }
    const auto* option = hostOption(*path);
    const auto type = option == nullptr ? ValueType::Any : option->type;
    const bool fits = (type == ValueType::Number && out.type == ParameterType::Number) ||
                      (type == ValueType::Whole && out.type == ParameterType::Integer);
    if (!fits || option->numbers.openLow || option->numbers.openHigh) {
        return fail(ErrorCode::InvalidArgument,
                    "{}: option is {}; an option of a host function with the same type and a range is expected, such "
                    "as analysis.variation.detection_ma",
                    where, shown(*path));
    }
    out.unit = option->unit;
    out.min = option->numbers.low;
    out.max = option->numbers.high;
    return {};
}

bool isName(std::string_view name) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    return !name.empty() && letter(name.front()) &&
           std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

/// With these parameters the operator vouches for a fact that the program cannot check, so the field must name it.
Result<void> saysWhatItVouchesFor(const ProtocolParameter& parameter) {
    struct OperatorStated {
        std::string_view name, unit, word;
    };
    constexpr OperatorStated kOperatorStated[] = {{"area", "cm2", "electrode"},
                                                  {"scope_gain_pct", "%", "Oscilloscope gain"},
                                                  {"timebase_ppm", "ppm", "time base"}};
    for (const auto& stated : kOperatorStated) {
        if (parameter.name != stated.name) continue;
        if (parameter.unit == stated.unit && parameter.label.find(stated.word) != std::string::npos) return {};
        return fail(ErrorCode::InvalidArgument,
                    "the parameter {} is labelled \"{}\" in \"{}\"; by it the operator vouches for something, so a "
                    "label with \"{}\" and the unit {} are expected",
                    parameter.name, parameter.label, parameter.unit, stated.word, stated.unit);
    }
    return {};
}

}  // namespace

std::string_view nameOf(ParameterType type) noexcept { return wordFor(kTypes, type); }

Result<ProtocolParameter> parseParameter(const std::string& name, const Json& given, const Json& choiceOrder) {
    if (const auto fits = noLongerThan("parameters", "a name", name, kMaxDeclaredTitle); !fits) return failure(fits);
    const std::string where = "parameter " + name;
    if (!isName(name)) {
        return fail(ErrorCode::InvalidArgument, "{}: a name has letters, digits and _ only, a letter first", where);
    }
    if (!given.is_object())
        return fail(ErrorCode::InvalidArgument, "{} is {}, an object is expected", where, shown(given));
    const auto known = onlyKeys(
        given, {"label", "type", "unit", "min", "max", "option", "choices", "value", "step", "needed", "zero"}, where);
    if (!known) return failure(known.map_error(asInvalidArgument));
    ProtocolParameter out;
    out.name = name;
    auto label = declaredText(given, where, "label", false);
    if (!label) return failure(label);
    out.label = label->empty() ? name : *label;
    auto unit = declaredText(given, where, "unit", false);
    if (!unit) return failure(unit);
    out.unit = *unit;
    auto type = typeOf(given, name);
    if (!type) return failure(type);
    out.type = *type;
    auto min = boundOf(given, name, "min");
    if (!min) return failure(min);
    auto max = boundOf(given, name, "max");
    if (!max) return failure(max);
    out.min = *min;
    out.max = *max;
    if (out.min && out.max && !(*out.min <= *out.max)) {
        return fail(ErrorCode::InvalidArgument, "{}: min {} is above max {}", where, *out.min, *out.max);
    }
    if (auto taken = takeOption(given, where, out); !taken) return failure(taken);
    if (auto choices = readChoices(given, choiceOrder, out); !choices) return failure(choices);
    if (const auto step = given.find("step"); step != given.end()) {
        if (*step != kReferenceStep) {
            return fail(ErrorCode::InvalidArgument, "{}: step is {}, {} is expected, or none", where, shown(*step),
                        kReferenceStep);
        }
        out.reference = true;
    }
    auto needed = declaredText(given, where, "needed", false, kMaxDeclaredTitle);
    if (!needed) return failure(needed);
    out.needed = *needed;
    auto zero = declaredText(given, where, "zero", false, kMaxDeclaredTitle);
    if (!zero) return failure(zero);
    out.zero = *zero;
    if (!out.zero.empty() && (out.type > ParameterType::Integer || !accepted(out, 0))) {
        return fail(ErrorCode::InvalidArgument, "{}: zero says what 0 stands for, and 0 is not accepted", where);
    }
    const auto value = given.find("value");
    if (value == given.end()) return fail(ErrorCode::InvalidArgument, "{} has no default: \"value\" is missing", where);
    if (value->is_string()) {
        const auto fits = noLongerThan(where, "value", value->get_ref<const std::string&>(), kMaxDeclaredText);
        if (!fits) return failure(fits);
    }
    auto usual = accepted(out, *value);
    if (!usual) return fail(ErrorCode::InvalidArgument, "the default of {}", usual.error().message);
    out.value = *usual;
    if (const auto honest = saysWhatItVouchesFor(out); !honest) return failure(honest);
    return out;
}

Result<Json> parseSetting(const ProtocolParameter& parameter, std::string_view text) {
    switch (parameter.type) {
        case ParameterType::Number:
        case ParameterType::Integer: {
            if (const auto number = typedNumber(text, parameter.unit)) return accepted(parameter, Json(*number));
            auto refused = accepted(parameter, Json(std::string(text)));
            if (!refused) refused.error().message += typedTrouble(text);
            return refused;
        }
        case ParameterType::Boolean:
            if (text == "true" || text == "yes" || text == "1") return Json(true);
            if (text == "false" || text == "no" || text == "0") return Json(false);
            return accepted(parameter, Json(std::string(text)));
        case ParameterType::Choice:
        case ParameterType::Text:
        case ParameterType::Date:
        case ParameterType::File:
            return accepted(parameter, Json(std::string(text)));
    }
    return accepted(parameter, Json(std::string(text)));
}

Json toJson(const ProtocolParameter& p) {
    Json one = {{"name", p.name}, {"label", p.label}, {"type", nameOf(p.type)}, {"value", p.value}};
    one["unit"] = p.unit.empty() ? Json() : Json(p.unit);
    one["min"] = p.min ? Json(*p.min) : Json();
    one["max"] = p.max ? Json(*p.max) : Json();
    if (p.reference) one["step"] = kReferenceStep;
    if (!p.needed.empty()) one["needed"] = p.needed;
    if (!p.zero.empty()) one["zero"] = p.zero;
    if (p.type == ParameterType::Choice) {
        one["choices"] = Json::array();
        for (const auto& [key, text] : p.choices) one["choices"].push_back({{"value", key}, {"label", text}});
    }
    return one;
}

}  // namespace tacto
