// ProtocolParameter.h - one parameter that a protocol script declares: its type, unit, range and accepted values.
//
// Thread-safety: values; the functions are pure.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

/// A date is written as 2027-03-01; a file is its path. An empty text is neither.
enum class ParameterType { Number, Integer, Choice, Text, Boolean, Date, File };
/// "number", "integer", "choice", "text", "boolean", "date", "file"
[[nodiscard]] std::string_view nameOf(ParameterType type) noexcept;

struct ProtocolParameter {
    std::string name;   ///< the key of --set, and the member of `p` in run(p)
    std::string label;  ///< the text for people; the name if the script declares no label
    std::string unit;   ///< "ohm", "s"; empty for a bare number
    ParameterType type = ParameterType::Number;
    std::optional<double> min;  ///< Number and Integer
    std::optional<double> max;
    std::vector<std::pair<std::string, std::string>> choices;  ///< Choice: key and its explanation, as written
    nlohmann::json value;                                      ///< Choice: keys and explanations, as written
    bool reference = false;  ///< true for `step: "reference"`: the step that reads the known reference first
    /// What stays unknown without a value. Then 0 or nothing is no answer, and a window asks for the value first.
    std::string needed;
    /// The meaning of 0 ("from the profile"), for a Number or Integer that accepts 0. Empty: 0 is just a number.
    std::string zero{};
    [[nodiscard]] bool operator==(const ProtocolParameter&) const = default;
};

/// Reads the declaration under `name`. `choiceOrder`: the keys of its choices, in the script's order. A name has at
/// most 200 characters, other texts 2000; whole numbers lie within ±2^53. Errors: InvalidArgument naming the parameter
/// and the key; also if the operator would vouch for something (the electrode's area) that its label or unit does not
/// name.
[[nodiscard]] Result<ProtocolParameter> parseParameter(const std::string& name, const nlohmann::json& given,
                                                       const nlohmann::json& choiceOrder);

/// Checks a value, given as text, against `parameter`. Errors: InvalidArgument naming key, value and accepted values.
[[nodiscard]] Result<nlohmann::json> parseSetting(const ProtocolParameter& parameter, std::string_view text);

/// Returns an element of `parameters` in cli.md's `protocols`.
[[nodiscard]] nlohmann::json toJson(const ProtocolParameter& parameter);

}  // namespace tacto
