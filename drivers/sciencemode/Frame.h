// Frame.h - the frames of ScienceMode4 (resources/design/wire/sciencemode4.md), to and from bytes.
//
//   F0 | 81 lenH^55 | 81 lenL^55 | 81 crcH^55 | 81 crcL^55 | stuffed body | 0F
//
// The length is the whole frame's; the CRC (CRC-16/XMODEM) is over the stuffed body. The body is a command (10 bits), a
// packet number (6 bits) and the payload; F0, 0F and 81 in it become 81, b^55. So inside a body neither F0 nor 0F
// occurs, but in the escaped length and CRC either may.
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

/// The longest message there is: ML_UPDATE of 8 channels with 16 points of 4 bytes each.
inline constexpr std::size_t kMaxPayload = 1 + 8 * (3 + 16 * 4);
inline constexpr std::size_t kMaxBody = 2 + kMaxPayload;
inline constexpr std::size_t kFrameOverhead = 10;
inline constexpr std::size_t kMinFrame = kFrameOverhead + 2;
inline constexpr std::size_t kMaxFrame = kFrameOverhead + 2 * kMaxBody;  // every byte stuffed
inline constexpr std::uint16_t kMaxCommand = 1023;
inline constexpr std::uint8_t kMaxNumber = 63;

/// A frame ready to be sent.
struct FrameBytes {
    std::array<std::uint8_t, kMaxFrame> bytes;  // not cleared: only the first `size` bytes mean anything
    std::size_t size = 0;
    [[nodiscard]] std::span<const std::uint8_t> view() const noexcept { return {bytes.data(), size}; }
};

/// The content of a frame. `payload` points into the caller's bytes.
struct Packet {
    std::uint16_t command = 0;
    std::uint8_t number = 0;
    std::span<const std::uint8_t> payload;
};

/// CRC-16/XMODEM: polynomial 1021, initial value 0, no reflection, no final xor.
[[nodiscard]] std::uint16_t crc16(std::span<const std::uint8_t> bytes) noexcept;

/// Errors: InvalidArgument for a command above 1023, a packet number above 63, a payload above kMaxPayload bytes.
[[nodiscard]] Result<void> encodeFrame(const Packet& packet, FrameBytes& into);

/// Finds frames in a stream of bytes. What is not a frame with a fitting length and CRC is skipped up to the next F0
/// that begins one, without losing a frame behind it. Memory is bounded by the longest frame.
class FrameDecoder {
public:
    /// Takes bytes off the front of `input` until a frame is complete (its payload is valid until the next call) or
    /// `input` is empty.
    [[nodiscard]] std::optional<Packet> take(std::span<const std::uint8_t>& input) noexcept;

    /// Bytes that belonged to no frame.
    [[nodiscard]] std::uint64_t junkBytes() const noexcept { return junk_; }
    /// How many of those began like a frame but had a wrong length, CRC, stuffing or end.
    [[nodiscard]] std::uint64_t brokenFrames() const noexcept { return broken_; }

private:
    enum class Finding { Incomplete, Complete, Broken };
    [[nodiscard]] Finding examine() noexcept;
    [[nodiscard]] bool unstuff() noexcept;
    void drop(std::size_t bytes) noexcept;
    void resynchronise() noexcept;

    std::array<std::uint8_t, kMaxFrame> buffer_{};  // begins with F0, or is empty
    std::size_t size_ = 0;
    std::size_t examined_ = 0;  // bytes of the buffer that fit a frame
    std::size_t length_ = 0;    // as the header says; 0 before it is known
    std::array<std::uint8_t, kMaxBody> body_{};
    std::size_t bodySize_ = 0;
    std::uint64_t junk_ = 0;
    std::uint64_t broken_ = 0;
};

}  // namespace tacto::sciencemode
