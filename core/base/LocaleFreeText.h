// LocaleFreeText.h - numbers to and from text, the same way in every language setting.
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

/// Takes the number that `text` begins with off it ("1e-3", "-4"): "2.5 kHz" leaves " kHz". Nothing, and `text` as it
/// was, where there is none and where a double cannot hold it. Accepts "nan" and "inf".
[[nodiscard]] std::optional<double> takeNumber(std::string_view& text);

/// The whole of `text`, blanks trimmed, as a number ("1e-3", "-4"). Nothing for an empty text, trailing
/// characters or a decimal comma. Accepts "nan" and "inf": whether those are welcome is the caller's rule.
[[nodiscard]] std::optional<double> parseNumber(std::string_view text);

/// A number with an optional engineering prefix and the given unit: "1.5 kohm", "500ohm", "50 nF", "500".
/// Prefixes p n u µ m k M G. Nothing when the text is something else.
[[nodiscard]] std::optional<double> parseQuantity(std::string_view text, std::string_view unit);

[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

// Small letters and capitals from A to Z, the same in every language setting. The functions of the C library follow the
// locale, which Qt sets: in Turkish the letter I has no small form of one byte.

[[nodiscard]] constexpr char lowered(char letter) noexcept {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}
[[nodiscard]] constexpr char capital(char letter) noexcept {
    return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
}

/// Other bytes than the letters A to Z stay as they are, so UTF-8 stays UTF-8.
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

/// Whether both are the same apart from small letters and capitals.
[[nodiscard]] constexpr bool sameLetters(std::string_view a, std::string_view b) noexcept {
    return std::ranges::equal(a, b, [](char x, char y) { return lowered(x) == lowered(y); });
}

// Texts in hexadecimal digits: digests, and the names of drawn files.

/// Whether a text consists of exactly so many characters from 0 to 9 and a to f.
[[nodiscard]] constexpr bool isHex(std::string_view text, std::size_t digits) noexcept {
    return text.size() == digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// A SHA-256 digest, as this program writes it.
[[nodiscard]] constexpr bool isSha256(std::string_view text) noexcept { return isHex(text, 64); }

// Whole numbers from text.

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

// Names that may be given once: a key, an option. Finds a second one, and words the sentence that refuses it.

/// The first of `values` whose projection equals an earlier one. Null when all differ.
template <class Values, class Projection = std::identity>
[[nodiscard]] constexpr auto secondIn(const Values& values, Projection projection = {}) -> decltype(&*values.begin()) {
    for (auto at = std::begin(values); at != std::end(values); ++at) {
        if (std::ranges::find(std::begin(values), at, std::invoke(projection, *at), projection) != at) return &*at;
    }
    return nullptr;
}

/// `the tag "a" is given twice; once is expected`: `text` with `args` names what is.
template <class... Args>
[[nodiscard]] std::string givenTwice(fmt::format_string<Args...> text, Args&&... args) {
    return fmt::format(text, std::forward<Args>(args)...) + " is given twice; once is expected";
}

}  // namespace tacto
