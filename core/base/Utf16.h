// Utf16.h - text in UTF-16, as spreadsheets save it, turned into the UTF-8 that everything here reads.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tacto {

enum class Utf16Order { Little, Big };

/// The order by the byte-order mark at the beginning of `bytes`; nothing where there is no mark.
[[nodiscard]] std::optional<Utf16Order> utf16OrderOf(std::string_view bytes) noexcept;

/// Bytes of UTF-8 that two bytes of UTF-16 become at most.
constexpr std::size_t kUtf8PerUtf16 = 3;

/// Appends `bytes` as UTF-8 and returns how many of them were used: a last odd byte, and the first half of a pair whose
/// second half is still to come, stay. Half a pair alone becomes U+FFFD.
[[nodiscard]] std::size_t appendAsUtf8(std::string_view bytes, Utf16Order order, std::string& text);

/// `bytes` themselves, or as UTF-8 where they begin with the mark of UTF-16; without the mark then.
[[nodiscard]] std::string asUtf8(std::string_view bytes);

/// `text` as UTF-8: itself where it is that, else read as Latin-1, as old programs write µ.
[[nodiscard]] std::string latin1AsUtf8(std::string_view text);

// A character as the bytes of UTF-8.

/// Writes `point`, up to 0x10FFFF, to the front of `bytes` and returns how many of them it takes.
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
