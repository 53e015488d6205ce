// Result.h - what a call that can fail gives back.
//
// An expected failure is a Result, never an exception; its message is one sentence that an operator
// can read: the thing, its value, and what would be accepted.
#pragma once

#include <fmt/format.h>
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace tacto {

/// The kinds of failure that callers treat differently.
enum class ErrorCode {
    InvalidArgument,  ///< a value that no caller may pass: not finite, negative, unknown name
    ParseError,       ///< a file or reply with a content that its format does not allow
    NotFound,         ///< a file, device or name that is not there
    Io,               ///< the operating system refused
    LimitExceeded,    ///< a safety limit would be broken; nothing was delivered
    NotArmed,         ///< the interlock's state does not permit output
    Stopped,          ///< ended by a stop, a fault or the operator
    Device,           ///< the device is gone, answers wrongly, or reports a fault
    Timeout,          ///< too late: no answer came in the time allowed, or what was to be done by then was not
    Unsupported,      ///< the device or build cannot do this
};

struct Error {
    ErrorCode code;
    std::string message;
};

template <class T = void>
using Result = tl::expected<T, Error>;

/// Builds the error arm of a Result: `return fail(ErrorCode::NotFound, "no file {}", path);`
template <class... Args>
[[nodiscard]] tl::unexpected<Error> fail(ErrorCode code, fmt::format_string<Args...> text, Args&&... args) {
    return tl::unexpected<Error>(Error{code, fmt::format(text, std::forward<Args>(args)...)});
}

/// The error for a value that no caller may pass: `return invalid("{} pulses; 1 or more are expected", pulses);`
template <class... Args>
[[nodiscard]] tl::unexpected<Error> invalid(fmt::format_string<Args...> text, Args&&... args) {
    return fail(ErrorCode::InvalidArgument, text, std::forward<Args>(args)...);
}

/// Passes another Result's error on: `if (!x) return failure(x);`
template <class T>
[[nodiscard]] tl::unexpected<Error> failure(const Result<T>& failed) {
    return tl::unexpected<Error>(failed.error());
}

}  // namespace tacto
