// HostParameter.h - one argument of a host function, or one member of an argument: its type, unit, range and default.
// The dispatcher checks the arguments from scripts against it, and the reference is generated from it.
//
// Thread-safety: values.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/ValueKind.h"

namespace tacto {

enum class ValueType {
    Number,  ///< NaN and infinities are always refused
    Whole,
    Text,
    Flag,
    List,
    Object,
    Load,  ///< ohms, or a text that parseLoad() accepts
    Any,   ///< checked by the function itself
};

/// All members of the last argument have names that begin like this.
inline constexpr std::string_view kOptionPrefix = "options.";

struct HostParameter {
    /// "seconds"; "from.roughness" for a member of an argument; "options.trains" for a member of the last argument,
    /// which may be left out and accepts only the members in the table.
    std::string_view name;
    ValueType type = ValueType::Any;
    std::string_view unit = {};                ///< "s", "ohm"; empty for values without a unit
    std::string_view about = {};               ///< what the value means
    AcceptedNumbers numbers = {};              ///< for Number and Whole: the accepted range
    ValueType items = ValueType::Any;          ///< type of a list's elements
    std::vector<std::string_view> words = {};  ///< the accepted texts; empty: any text
    std::size_t mostCharacters = 0;            ///< the longest text; 0: any length
    bool mayBeLeftOut = false;
    bool mayBeEmpty = false;          ///< for texts: an empty text is accepted
    bool mayBeNull = false;           ///< null and NaN are accepted and mean "not known"
    nlohmann::json usual = {};        ///< the value if the argument is left out
    std::string_view usualText = {};  ///< the default in words, if the function computes it

    // The range. Tables use it like this: number("seconds", "s", "on the bench's clock").range(0, 86'400).otherwise(1)
    [[nodiscard]] HostParameter range(double from, double to) const;
    [[nodiscard]] HostParameter atLeast(double from) const;
    [[nodiscard]] HostParameter above(double from) const;
    [[nodiscard]] HostParameter of(ValueType elements) const;
    [[nodiscard]] HostParameter oneOf(std::vector<std::string_view> accepted) const;
    [[nodiscard]] HostParameter atMost(std::size_t characters) const;
    [[nodiscard]] HostParameter orEmpty() const;
    [[nodiscard]] HostParameter orNull() const;
    [[nodiscard]] HostParameter otherwise(nlohmann::json value) const;
    [[nodiscard]] HostParameter optional(std::string_view whereLeftOut = {}) const;

    /// Returns the accepted values for errors and for the reference: "a whole number from 1 to 64".
    [[nodiscard]] std::string accepted() const;
    [[nodiscard]] bool accepts(const nlohmann::json& value) const;
    /// Returns the default with its unit, or an empty text if there is none.
    [[nodiscard]] std::string defaultText() const;
};

/// Makes parameters by their type, for the tables of host functions.
namespace takes {
[[nodiscard]] HostParameter number(std::string_view name, std::string_view unit, std::string_view about);
[[nodiscard]] HostParameter whole(std::string_view name, std::string_view about);
[[nodiscard]] HostParameter text(std::string_view name, std::string_view about);
[[nodiscard]] HostParameter flag(std::string_view name, std::string_view about);
[[nodiscard]] HostParameter list(std::string_view name, std::string_view about);
[[nodiscard]] HostParameter object(std::string_view name, std::string_view about);
[[nodiscard]] HostParameter load(std::string_view name, std::string_view about);
[[nodiscard]] HostParameter any(std::string_view name, std::string_view about);
}  // namespace takes

}  // namespace tacto
