// Ascii.h - letters A to Z in small and in capitals, in every language setting alike. The functions of the C library
// follow the locale, which Qt sets: in Turkish the letter I has no small form of one byte.
//
// Thread-safety: pure functions.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace tacto {

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

/// Whether both are the same but for small letters and capitals.
[[nodiscard]] constexpr bool sameLetters(std::string_view a, std::string_view b) noexcept {
    return std::ranges::equal(a, b, [](char x, char y) { return lowered(x) == lowered(y); });
}

}  // namespace tacto
