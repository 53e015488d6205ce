// Refused.h - helpers to check a Result: unwrap an accepted value, or match the code and sentence of an error.
//
// Thread-safety: pure functions.
#pragma once

#include <gmock/gmock.h>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/base/Result.h"

namespace tacto::test {

/// Returns the value in `given`; if it holds an error, the test fails with the error's message.
template <typename Given>
auto accepted(Given given) {
    if constexpr (requires { given.error().message; }) {
        if (!given) throw std::runtime_error(given.error().message);
    }
    if constexpr (!std::is_void_v<typename Given::value_type>) return std::move(given).value();
}

/// Matches a failed Result with a message that contains `says`, or that the matcher `says` accepts.
MATCHER_P(refusedSaying, says, "is refused") {
    if (arg) {
        *result_listener << "it was accepted";
        return false;
    }
    const std::string& message = arg.error().message;
    *result_listener << "\"" << message << "\"";
    if constexpr (std::is_convertible_v<decltype(says), std::string_view>)
        return message.find(says) != std::string::npos;
    else
        return testing::Matches(says)(message);
}

/// Matches a failed Result with this code.
MATCHER_P(refused, code, "is refused") { return !arg && arg.error().code == code; }

/// Matches a failed Result with this code and message.
template <typename Says>
auto refused(ErrorCode code, Says says) {
    return testing::AllOf(refused(code), refusedSaying(says));
}

}  // namespace tacto::test
