// Frame.h - encodes and decodes the frames of ScienceMode4 (resources/design/wire/sciencemode4.md).
//
//   F0 | 81 lenH^55 | 81 lenL^55 | 81 crcH^55 | 81 crcL^55 | stuffed body | 0F
//
// The length counts the whole frame; the CRC (CRC-16/XMODEM) covers the stuffed body. The body is a command (10 bits),
// a packet number (6 bits) and the payload; stuffing replaces each F0, 0F and 81 (b) in it by 81, b^55. So F0 and 0F
// never occur inside a body, but either may occur in the escaped length and CRC.
//
// Thread-safety: encodeFrame() is pure; a FrameDecoder has one owner. Neither allocates when it succeeds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/Result.h"

namespace tacto::sciencemode {

/// Payload of the longest message: ML_UPDATE of 8 channels with 16 points of 4 bytes each.
inline constexpr std::size_t kMaxPayload = 1 + 8 * (3 + 16 * 4);
inline constexpr std::size_t kMaxBody = 2 + kMaxPayload;
inline constexpr std::size_t kFrameOverhead = 10;
inline constexpr std::size_t kMinFrame = kFrameOverhead + 2;
inline constexpr std::size_t kMaxFrame = kFrameOverhead + 2 * kMaxBody;  // every byte stuffed
inline constexpr std::uint16_t kMaxCommand = 1023;
inline constexpr std::uint8_t kMaxNumber = 63;

/// A frame ready to be sent.
struct FrameBytes {
    std::array<std::uint8_t, kMaxFrame> bytes;  // not cleared: only the first `size` bytes are valid
    std::size_t size = 0;
    [[nodiscard]] std::span<const std::uint8_t> view() const noexcept { return {bytes.data(), size}; }
};

/// The content of a frame. `payload` points into the bytes of the encoder's caller or of the decoder.
struct Packet {
    std::uint16_t command = 0;
    std::uint8_t number = 0;
    std::span<const std::uint8_t> payload;
};

/// CRC-16/XMODEM: polynomial 1021, initial value 0, no reflection, no final xor.
[[nodiscard]] std::uint16_t crc16(std::span<const std::uint8_t> bytes) noexcept;

/// Errors: InvalidArgument for a command above 1023, a packet number above 63, a payload above kMaxPayload bytes.
[[nodiscard]] Result<void> encodeFrame(const Packet& packet, FrameBytes& into);

/// Finds frames in a stream of bytes. Bytes that are no frame with a valid length and CRC are skipped up to the next F0
/// that begins a frame; no frame is lost by that. Memory is limited to the longest frame.
class FrameDecoder {
public:
    /// Takes bytes from the front of `input` until a frame is complete or `input` is empty. The returned payload is
    /// valid until the next call.
    [[nodiscard]] std::optional<Packet> take(std::span<const std::uint8_t>& input) noexcept;

    /// Returns how many bytes belonged to no frame.
    [[nodiscard]] std::uint64_t junkBytes() const noexcept { return junk_; }
    /// Returns how often bytes began like a frame but had a wrong length, CRC, stuffing or end.
    [[nodiscard]] std::uint64_t brokenFrames() const noexcept { return broken_; }

private:
    enum class Finding { Incomplete, Complete, Broken };
    [[nodiscard]] Finding examine() noexcept;
    [[nodiscard]] bool unstuff() noexcept;
    void drop(std::size_t bytes) noexcept;
    void resynchronise() noexcept;

    std::array<std::uint8_t, kMaxFrame> buffer_{};  // begins with F0, or is empty
    std::size_t size_ = 0;
    std::size_t examined_ = 0;  // bytes of the buffer that were checked and fit a frame
    std::size_t length_ = 0;    // frame length from the header; 0 before it is known
    std::array<std::uint8_t, kMaxBody> body_{};
    std::size_t bodySize_ = 0;
    std::uint64_t junk_ = 0;
    std::uint64_t broken_ = 0;
};

}  // namespace tacto::sciencemode
