// Hex.h - what is written in hexadecimal digits: digests, and the names of files that are drawn.
//
// Thread-safety: a pure function.
#pragma once

#include <cstddef>
#include <string_view>

namespace tacto {

/// Whether a text is exactly so many of 0 to 9 and a to f.
[[nodiscard]] constexpr bool isHex(std::string_view text, std::size_t digits) noexcept {
    return text.size() == digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// A SHA-256 digest, as this program writes it.
[[nodiscard]] constexpr bool isSha256(std::string_view text) noexcept { return isHex(text, 64); }

}  // namespace tacto
