// Say.h - prints text. Text from files, scripts and devices is first made harmless for a terminal (hazard H10).
//
// The format is part of the program and printed unchanged. In text arguments, control characters, also newlines, are
// replaced by printable text (core/base/Printable.h). lines() keeps newlines, for texts with several lines.
//
// Thread-safety: any thread, like the C library's streams.
#pragma once

#include <cstdio>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/base/Printable.h"

namespace tacto::cli {

/// A text with several lines, such as an error message with a template to fill in.
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
