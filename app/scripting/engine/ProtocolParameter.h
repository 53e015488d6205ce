// ProtocolParameter.h - one parameter that a protocol script declares: its type, unit and range, and what it takes as a
// value.
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

/// A day is written as 2027-03-01, a file is its path; an empty text is neither.
enum class ParameterType { Number, Integer, Choice, Text, Boolean, Date, File };
/// "number", "integer", "choice", "text", "boolean", "date", "file"
[[nodiscard]] std::string_view nameOf(ParameterType type) noexcept;

struct ProtocolParameter {
    std::string name;   ///< the key of --set and of `p` in run(p)
    std::string label;  ///< what people read; the name where the script gives none
    std::string unit;   ///< "ohm", "s"; empty for a bare number
    ParameterType type = ParameterType::Number;
    std::optional<double> min;  ///< Number and Integer
    std::optional<double> max;
    std::vector<std::pair<std::string, std::string>> choices;  ///< Choice: key and its explanation, as written
    nlohmann::json value;                                      ///< the default, within the range
    bool reference = false;  ///< the step that first reads the known reference: `step: "reference"`
    /// What stays unknown without it; then 0 or nothing is not an answer, and a window asks for it first. May be empty.
    std::string needed;
    /// The meaning of 0: "from the profile"; for Number and Integer that take 0. Empty: the number itself.
    std::string zero{};
    [[nodiscard]] bool operator==(const ProtocolParameter&) const = default;
};

/// Reads what a script declares under `name`. `choiceOrder`: the keys of its choices as written. A name has at most 200
/// characters, any other text 2000; a whole number lies within ±2^53.
/// Errors: InvalidArgument naming the parameter and the key; also where the operator would vouch for something by it
/// (the electrode's area) that its label or unit does not name.
[[nodiscard]] Result<ProtocolParameter> parseParameter(const std::string& name, const nlohmann::json& given,
                                                       const nlohmann::json& choiceOrder);

/// Checks one value as text against its parameter. Errors: InvalidArgument naming key, value and what is accepted.
[[nodiscard]] Result<nlohmann::json> parseSetting(const ProtocolParameter& parameter, std::string_view text);

/// An element of `parameters` in cli.md's `protocols`.
[[nodiscard]] nlohmann::json toJson(const ProtocolParameter& parameter);

}  // namespace tacto
