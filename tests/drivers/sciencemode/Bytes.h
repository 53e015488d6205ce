// Bytes.h - bytes from a text as protocol documents write them: "F0 81 55".
//
// Thread-safety: pure functions.
#pragma once

#include <charconv>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tacto::test {

[[nodiscard]] inline std::vector<std::uint8_t> bytesOf(std::string_view hex) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t at = 0; at + 1 < hex.size(); at += 3) {
        std::uint8_t byte = 0;
        std::from_chars(hex.data() + at, hex.data() + at + 2, byte, 16);
        bytes.push_back(byte);
    }
    return bytes;
}

}  // namespace tacto::test
