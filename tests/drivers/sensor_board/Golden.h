// Golden.h - the golden frames of PROTOCOL.md, read from the document itself.
//
// Thread-safety: any thread; reads files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tacto::test {

struct GoldenFrame {
    std::string text;  ///< such as "HELLO, token 1"
    std::vector<std::uint8_t> bytes;
    [[nodiscard]] bool fromHost() const noexcept { return bytes.size() > 2 && typeByte() < 0x40; }
    /// COBS does not change the second byte of the content, because it is not zero.
    [[nodiscard]] std::uint8_t typeByte() const noexcept { return bytes[2]; }
};

/// Returns all frames in their order.
[[nodiscard]] const std::vector<GoldenFrame>& goldenFrames();
/// Returns the frame with a text that begins with `text`.
[[nodiscard]] const std::vector<std::uint8_t>& golden(std::string_view text);

}  // namespace tacto::test
