// LocaleFreeText.h - converts between numbers and text, in the same way for every language setting.
#pragma once

#include <algorithm>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tacto {

/// Reads the number at the start of `text` ("1e-3", "-4") and removes it: "2.5 kHz" leaves " kHz". Accepts "nan" and
/// "inf". Returns nothing, and keeps `text`, if there is no number or a double cannot hold it.
[[nodiscard]] std::optional<double> takeNumber(std::string_view& text);

/// Reads all of `text`, without outer blanks, as a number ("1e-3", "-4"). Returns nothing for an empty text, trailing
/// characters or a decimal comma. Accepts "nan" and "inf"; the caller decides about those.
[[nodiscard]] std::optional<double> parseNumber(std::string_view text);

/// Reads a number with an optional engineering prefix and the given unit: "1.5 kohm", "500ohm", "50 nF", "500".
/// Prefixes: p n u µ m k M G. Returns nothing for any other text.
[[nodiscard]] std::optional<double> parseQuantity(std::string_view text, std::string_view unit);

[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

// Lower and upper case of the letters A to Z, the same for every language setting. The functions of the C library
// follow the locale, which Qt sets: in Turkish the lower case of I is not a single byte.

[[nodiscard]] constexpr char lowered(char letter) noexcept {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}
[[nodiscard]] constexpr char capital(char letter) noexcept {
    return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
}

/// Changes only the letters A to Z, so that UTF-8 stays UTF-8.
[[nodiscard]] inline std::string lowered(std::string_view text) {
    std::string result(text);
    for (char& letter : result) letter = lowered(letter);
    return result;
}
[[nodiscard]] inline std::string capitals(std::string_view text) {
    std::string result(text);
    for (char& letter : result) letter = capital(letter);
    return result;
}

/// Whether both texts are the same if case is ignored.
[[nodiscard]] constexpr bool sameLetters(std::string_view a, std::string_view b) noexcept {
    return std::ranges::equal(a, b, [](char x, char y) { return lowered(x) == lowered(y); });
}

// Texts of hexadecimal digits: digests, and random file names.

/// Whether a text is exactly `digits` characters from 0 to 9 and a to f.
[[nodiscard]] constexpr bool isHex(std::string_view text, std::size_t digits) noexcept {
    return text.size() == digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Whether a text is a SHA-256 digest as this program writes it.
[[nodiscard]] constexpr bool isSha256(std::string_view text) noexcept { return isHex(text, 64); }

// Whole numbers from text.

/// Reads all of `text` as a number: digits of `base`, after a minus if T is signed. Returns nothing for an empty text,
/// a plus, blanks, other characters, or a number that T cannot hold.
template <std::integral T>
[[nodiscard]] std::optional<T> parseWhole(std::string_view text, int base = 10) noexcept {
    T value = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value, base);
    if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
    return value;
}

// Names that may be given only once, such as a key or an option: find a repeated name, and word the error.

/// Returns the first of `values` with the same projection as an earlier value; null if all differ.
template <class Values, class Projection = std::identity>
[[nodiscard]] constexpr auto secondIn(const Values& values, Projection projection = {}) -> decltype(&*values.begin()) {
    for (auto at = std::begin(values); at != std::end(values); ++at) {
        if (std::ranges::find(std::begin(values), at, std::invoke(projection, *at), projection) != at) return &*at;
    }
    return nullptr;
}

/// Returns a sentence such as `the tag "a" is given twice; once is expected`; `text` and `args` say what is given.
template <class... Args>
[[nodiscard]] std::string givenTwice(fmt::format_string<Args...> text, Args&&... args) {
    return fmt::format(text, std::forward<Args>(args)...) + " is given twice; once is expected";
}

}  // namespace tacto
