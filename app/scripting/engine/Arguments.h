// Arguments.h - the arguments of a call to a host function, checked against its parameters before the function runs.
//
// Host functions read arguments by parameter name and check only how values relate to each other. Reading a name or
// type that the function did not declare is a mistake in the program: std::logic_error.
//
// Thread-safety: values. The function and the list must outlive them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "app/scripting/engine/HostFunction.h"
#include "core/base/Result.h"

namespace tacto {

/// Returns the value as JSON on one line, for messages; shortened to 60 characters.
[[nodiscard]] std::string shown(const nlohmann::json& value);

class Arguments {
public:
    /// Errors: InvalidArgument in one sentence that names function, argument, value and what is accepted: for a wrong
    /// type, NaN or an infinity, a number outside its range, an unknown word or option, or a missing argument.
    [[nodiscard]] static Result<Arguments> check(const HostFunction& function, const nlohmann::json& list);

    // An argument that was left out has its parameter's default; without a default: `fallback`, NaN or empty.
    [[nodiscard]] double number(std::string_view name) const;
    [[nodiscard]] double number(std::string_view name, double fallback) const;
    [[nodiscard]] int whole(std::string_view name, int fallback = 0) const;
    [[nodiscard]] bool flag(std::string_view name) const;
    [[nodiscard]] std::string text(std::string_view name) const;
    [[nodiscard]] const nlohmann::json& list(std::string_view name) const;
    [[nodiscard]] const nlohmann::json& object(std::string_view name) const;
    /// Returns the load in the form that parseLoad() reads.
    [[nodiscard]] std::string load(std::string_view name) const;
    /// Returns null if the argument was left out.
    [[nodiscard]] const nlohmann::json& any(std::string_view name) const;
    [[nodiscard]] bool has(std::string_view name) const;
    /// True if the script passed null, which means "not known"; false if it left the argument out.
    [[nodiscard]] bool isNull(std::string_view name) const;
    /// Everything that was passed, in order.
    [[nodiscard]] const nlohmann::json& all() const noexcept { return list_; }

    /// Returns the object of the called function: "bench.loadSafety".
    [[nodiscard]] std::string_view object() const noexcept { return function_.object; }

    /// Returns the error for a value that the function rejects: "bench.wait: seconds is 3, ACCEPTED is expected".
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

/// Returns an error such as: analysis.calibration: direction is 3, "up", "down" or "" is expected.
[[nodiscard]] tl::unexpected<Error> otherThanExpected(std::string_view function, std::string_view name,
                                                      const nlohmann::json& value, std::string_view accepted);

/// Returns the answer of a host function that has no result.
template <class T>
[[nodiscard]] Result<nlohmann::json> done(const Result<T>& result) {
    if (!result) return failure(result);
    return nlohmann::json();
}

}  // namespace tacto
