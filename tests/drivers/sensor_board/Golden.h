// Golden.h - the golden frames of PROTOCOL.md, read from the document itself.
//
// Thread-safety: reads files; no state.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tacto::test {

struct GoldenFrame {
    std::string text;  ///< "HELLO, token 1"
    std::vector<std::uint8_t> bytes;
    [[nodiscard]] bool fromHost() const noexcept { return bytes.size() > 2 && typeByte() < 0x40; }
    /// COBS leaves the second byte of content, which is not zero, where it is.
    [[nodiscard]] std::uint8_t typeByte() const noexcept { return bytes[2]; }
};

/// All frames, in their order.
[[nodiscard]] const std::vector<GoldenFrame>& goldenFrames();
/// The frame whose text begins with `text`.
[[nodiscard]] const std::vector<std::uint8_t>& golden(std::string_view text);

}  // namespace tacto::test
