// Result.h - the return type of calls that can fail.
//
// An expected failure is a Result, never an exception. Its message is one sentence for an operator: the thing, its
// value, and what would be accepted.
#pragma once

#include <fmt/format.h>
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace tacto {

/// The kinds of failure that callers treat differently.
enum class ErrorCode {
    InvalidArgument,  ///< a value that callers must not pass: not finite, negative, unknown name
    ParseError,       ///< a file or reply whose content is against its format
    NotFound,         ///< a file, device or name that does not exist
    Io,               ///< the operating system refused
    LimitExceeded,    ///< a safety limit would be exceeded; nothing was delivered
    NotArmed,         ///< the interlock does not permit output in its present state
    Stopped,          ///< ended by a stop, a fault or the operator
    Device,           ///< the device is gone, answers wrongly or reports a fault
    Timeout,          ///< no answer, or nothing done, within the time allowed
    Unsupported,      ///< the device or build cannot do this
};

struct Error {
    ErrorCode code;
    std::string message;
};

template <class T = void>
using Result = tl::expected<T, Error>;

/// Returns an error for a Result: `return fail(ErrorCode::NotFound, "no file {}", path);`
template <class... Args>
[[nodiscard]] tl::unexpected<Error> fail(ErrorCode code, fmt::format_string<Args...> text, Args&&... args) {
    return tl::unexpected<Error>(Error{code, fmt::format(text, std::forward<Args>(args)...)});
}

/// Returns an error for an invalid value: `return invalid("{} pulses; 1 or more are expected", pulses);`
template <class... Args>
[[nodiscard]] tl::unexpected<Error> invalid(fmt::format_string<Args...> text, Args&&... args) {
    return fail(ErrorCode::InvalidArgument, text, std::forward<Args>(args)...);
}

/// Passes on the error of another Result: `if (!x) return failure(x);`
template <class T>
[[nodiscard]] tl::unexpected<Error> failure(const Result<T>& failed) {
    return tl::unexpected<Error>(failed.error());
}

}  // namespace tacto
