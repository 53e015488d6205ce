// WholeNumber.h - whole numbers from text.
//
// Thread-safety: a pure function.
#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string_view>

namespace tacto {

/// The whole of `text` as a number: digits of `base`, after a minus where T has a sign. Nothing for an empty text, a
/// plus, blanks, other characters and what T cannot hold.
template <std::integral T>
[[nodiscard]] std::optional<T> parseWhole(std::string_view text, int base = 10) noexcept {
    T value = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value, base);
    if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
    return value;
}

}  // namespace tacto
