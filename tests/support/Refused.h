// Refused.h - what a call must give, and what a refused one says: its code, and its sentence or a part of it.
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

/// What a call gave; where it gave none, the test fails with what it said.
template <typename Given>
auto accepted(Given given) {
    if constexpr (requires { given.error().message; }) {
        if (!given) throw std::runtime_error(given.error().message);
    }
    if constexpr (!std::is_void_v<typename Given::value_type>) return std::move(given).value();
}

/// A result that failed with a sentence that holds `says`, or that a matcher `says` matches.
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

/// A result that failed with `code`.
MATCHER_P(refused, code, "is refused") { return !arg && arg.error().code == code; }

/// With both.
template <typename Says>
auto refused(ErrorCode code, Says says) {
    return testing::AllOf(refused(code), refusedSaying(says));
}

}  // namespace tacto::test
