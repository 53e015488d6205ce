// Arguments.h - what a script passed to a host function, checked against the function's parameters before it is called.
//
// Functions read by the names of their parameters and check nothing again but how values relate. To read a name or a
// type that the function did not declare is a mistake of the program: std::logic_error.
//
// Thread-safety: values. The function and the list outlive them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "app/scripting/engine/HostFunction.h"
#include "core/base/Result.h"

namespace tacto {

/// One line for messages: the value as JSON, shortened to 60 characters.
[[nodiscard]] std::string shown(const nlohmann::json& value);

class Arguments {
public:
    /// Errors: InvalidArgument in one sentence that names function, argument, value and what is accepted: for a wrong
    /// type, NaN or an infinity, a number outside its range, a word or an option that there is not, and an argument
    /// that is missing.
    [[nodiscard]] static Result<Arguments> check(const HostFunction& function, const nlohmann::json& list);

    // The number; if it was left out, the parameter's default, or without one `fallback`, NaN, or empty.
    [[nodiscard]] double number(std::string_view name) const;
    [[nodiscard]] double number(std::string_view name, double fallback) const;
    [[nodiscard]] int whole(std::string_view name, int fallback = 0) const;
    [[nodiscard]] bool flag(std::string_view name) const;
    [[nodiscard]] std::string text(std::string_view name) const;
    [[nodiscard]] const nlohmann::json& list(std::string_view name) const;
    [[nodiscard]] const nlohmann::json& object(std::string_view name) const;
    /// The load, as parseLoad() reads it.
    [[nodiscard]] std::string load(std::string_view name) const;
    /// Null where it was left out.
    [[nodiscard]] const nlohmann::json& any(std::string_view name) const;
    [[nodiscard]] bool has(std::string_view name) const;
    /// Passed as null: not known, which is something else than left out.
    [[nodiscard]] bool isNull(std::string_view name) const;
    /// Everything that was passed, in order.
    [[nodiscard]] const nlohmann::json& all() const noexcept { return list_; }

    /// "bench.loadSafety", of the function that was called.
    [[nodiscard]] std::string_view object() const noexcept { return function_.object; }

    /// The error for what a function finds wrong by itself: "bench.wait: seconds is 3, ACCEPTED is expected".
    [[nodiscard]] tl::unexpected<Error> wrong(std::string_view name, const nlohmann::json& value,
                                              std::string_view accepted) const;

private:
    Arguments(const HostFunction& function, const nlohmann::json& list) : function_(function), list_(list) {}
    [[nodiscard]] Result<void> check(const HostParameter& parameter) const;
    [[nodiscard]] Result<void> checkMembers(std::string_view of) const;
    [[nodiscard]] const std::vector<HostParameter>& parameters() const noexcept;
    [[nodiscard]] const nlohmann::json& passed(std::string_view name) const;
    [[nodiscard]] const nlohmann::json& value(std::string_view name, ValueType type) const;

    const HostFunction& function_;
    const nlohmann::json& list_;
};

/// "analysis.calibration: direction is 3, "up", "down" or "" is expected".
[[nodiscard]] tl::unexpected<Error> otherThanExpected(std::string_view function, std::string_view name,
                                                      const nlohmann::json& value, std::string_view accepted);

/// The answer of a host function that returns nothing.
template <class T>
[[nodiscard]] Result<nlohmann::json> done(const Result<T>& result) {
    if (!result) return failure(result);
    return nlohmann::json();
}

}  // namespace tacto
