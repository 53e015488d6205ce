// Utf8.h - a character as the bytes of UTF-8.
//
// Thread-safety: pure functions.
#pragma once

#include <array>
#include <cstddef>

namespace tacto {

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
