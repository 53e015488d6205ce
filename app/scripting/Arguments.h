// Arguments.h - reads what a script passed to a host function, and says in one sentence what was wrong with it.
//
// Thread-safety: values.
#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

/// What a number must be. NaN and infinities are always refused.
struct NumberRange {
    double min = std::numeric_limits<double>::lowest();
    double max = std::numeric_limits<double>::max();
    bool whole = false;
};

/// One line for messages: the value as JSON, shortened to 60 characters.
[[nodiscard]] std::string shown(const nlohmann::json& value);

class Arguments {
public:
    /// `function` names the function in errors: "bench.wait".
    Arguments(std::string_view function, const nlohmann::json& list) : function_(function), list_(list) {}

    /// The argument at `index`, null when it was left out.
    [[nodiscard]] const nlohmann::json& at(std::size_t index) const;
    // Errors of all: InvalidArgument naming function, argument, its value and what is accepted.
    [[nodiscard]] Result<double> number(std::size_t index, std::string_view name, NumberRange range = {}) const;
    [[nodiscard]] Result<std::string> text(std::size_t index, std::string_view name) const;
    /// An object, or an empty one when left out. Refuses members that are not in `known`: a typing error must not
    /// silently leave a default in force.
    [[nodiscard]] Result<nlohmann::json> options(std::size_t index, std::vector<std::string_view> known) const;
    [[nodiscard]] Result<const nlohmann::json*> list(std::size_t index, std::string_view name) const;
    [[nodiscard]] Result<const nlohmann::json*> object(std::size_t index, std::string_view name) const;

    /// A member of an object; `fallback` when it is absent.
    [[nodiscard]] Result<double> number(const nlohmann::json& object, std::string_view key, double fallback,
                                        NumberRange range = {}) const;
    [[nodiscard]] Result<std::string> text(const nlohmann::json& object, std::string_view key,
                                           std::string_view fallback) const;
    [[nodiscard]] Result<bool> flag(const nlohmann::json& object, std::string_view key, bool fallback) const;

    [[nodiscard]] tl::unexpected<Error> wrong(std::string_view name, const nlohmann::json& value,
                                              std::string_view accepted) const;

private:
    [[nodiscard]] Result<double> checked(const nlohmann::json& value, std::string_view name, NumberRange range) const;
    std::string_view function_;
    const nlohmann::json& list_;
};

}  // namespace tacto
