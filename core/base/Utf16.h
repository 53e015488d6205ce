// Utf16.h - converts UTF-16 text, as spreadsheets save it, to UTF-8, which all other code reads.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tacto {

enum class Utf16Order { Little, Big };

/// Returns the byte order from the mark at the start of `bytes`; nothing if there is no mark.
[[nodiscard]] std::optional<Utf16Order> utf16OrderOf(std::string_view bytes) noexcept;

/// The most bytes of UTF-8 for two bytes of UTF-16.
constexpr std::size_t kUtf8PerUtf16 = 3;

/// Appends `bytes` as UTF-8 and returns how many were used. Leaves a last odd byte, and the first half of a pair whose
/// second half is not there yet. A lone half of a pair becomes U+FFFD.
[[nodiscard]] std::size_t appendAsUtf8(std::string_view bytes, Utf16Order order, std::string& text);

/// Converts `bytes` to UTF-8, without the mark, if they start with the mark of UTF-16; else returns them unchanged.
[[nodiscard]] std::string asUtf8(std::string_view bytes);

/// Returns `text` if it is UTF-8; else converts it from Latin-1, which old programs use for µ.
[[nodiscard]] std::string latin1AsUtf8(std::string_view text);

// Encodes a character as UTF-8.

/// Writes `point`, up to 0x10FFFF, to the start of `bytes` and returns the number of bytes written.
constexpr std::size_t encodeUtf8(char32_t point, std::array<char, 4>& bytes) noexcept {
    std::size_t size = 0;
    const auto put = [&](char32_t byte) { bytes[size++] = static_cast<char>(byte); };
    if (point < 0x80) {
        put(point);
    } else if (point < 0x800) {
        put(0xC0U | point >> 6U);
        put(0x80U | (point & 0x3FU));
    } else if (point < 0x10000) {
        put(0xE0U | point >> 12U);
        put(0x80U | (point >> 6U & 0x3FU));
        put(0x80U | (point & 0x3FU));
    } else {
        put(0xF0U | point >> 18U);
        put(0x80U | (point >> 12U & 0x3FU));
        put(0x80U | (point >> 6U & 0x3FU));
        put(0x80U | (point & 0x3FU));
    }
    return size;
}

}  // namespace tacto
