// Say.h - how the program prints: text that comes from files, scripts and devices is made harmless to a terminal first
// (hazard H10).
//
// The format is the program's own and printed as it is; of every text among the arguments, control characters are
// spelled out (core/base/Printable.h), a newline too. lines() keeps newlines, for texts that have several lines.
//
// Thread-safety: any thread, as the C library's streams.
#pragma once

#include <cstdio>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/base/Printable.h"

namespace tacto::cli {

/// A text of several lines. A sentence of an error may be one: a template to fill in.
struct Lines {
    std::string text;  // printable
};
[[nodiscard]] inline Lines lines(std::string_view text) { return {printable(text, Newlines::Keep)}; }

namespace detail {
template <class T>
[[nodiscard]] decltype(auto) harmless(const T& value) {
    if constexpr (std::is_convertible_v<const T&, std::string_view>)
        return printable(value);
    else
        return (value);
}
}  // namespace detail

template <class... Args>
void say(std::FILE* to, fmt::format_string<Args...> format, Args&&... args) {
    const auto text = [&](const auto&... harmless) {
        return fmt::vformat(format, fmt::make_format_args(harmless...));
    }(detail::harmless(args)...);
    static_cast<void>(std::fwrite(text.data(), 1, text.size(), to));
}

template <class... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
    say(stdout, format, std::forward<Args>(args)...);
}

}  // namespace tacto::cli

template <>
struct fmt::formatter<tacto::cli::Lines> : fmt::formatter<std::string_view> {
    auto format(const tacto::cli::Lines& lines, fmt::format_context& context) const {
        return fmt::formatter<std::string_view>::format(lines.text, context);
    }
};
