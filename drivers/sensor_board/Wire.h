// Wire.h - frames of the sensor board protocol (resources/firmware/sensor_board/PROTOCOL.md, sections 2 and 3) to and
// from bytes, on the host's side.
//
//   COBS( version | type | payload | CRC-32 ) | 00        content at most 254 bytes
//
// Written from the specification, apart from the firmware's C code, so that each tests the other.
//
// Thread-safety: a FrameDecoder has one owner; it never allocates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tacto::sensorboard {

inline constexpr std::uint8_t kVersion = 1;
inline constexpr std::size_t kMaxContent = 254;  ///< version to CRC
inline constexpr std::size_t kMinContent = 6;    ///< version, type, CRC
inline constexpr std::size_t kMaxStuffed = 255;  ///< before the delimiter
inline constexpr std::size_t kMaxPayload = kMaxContent - kMinContent;

enum class Command : std::uint8_t {
    Hello = 0x01,
    GetConfiguration = 0x02,
    SetConfiguration = 0x03,
    GetCalibration = 0x04,
    Start = 0x05,
    Stop = 0x06,
    GetStatus = 0x07,
};

enum class Reply : std::uint8_t {
    Identity = 0x41,
    Configuration = 0x42,
    Calibration = 0x44,
    Done = 0x45,
    Status = 0x46,
    Refused = 0x4F,
    Data = 0x50,
};

/// A frame with a right CRC. `payload` points into the decoder, until its next call.
struct Frame {
    std::uint8_t version = 0;
    std::uint8_t type = 0;
    std::span<const std::uint8_t> payload;

    [[nodiscard]] bool is(Reply reply) const noexcept {
        return version == kVersion && type == static_cast<std::uint8_t>(reply);
    }
};

/// The counts of a line. They only grow.
struct LineCounts {
    std::uint64_t bytes = 0;
    std::uint64_t frames = 0;     ///< frames whose CRC was right
    std::uint64_t badCrc = 0;     ///< whole, and wrong
    std::uint64_t malformed = 0;  ///< frames that were not COBS, or too short
    std::uint64_t tooLong = 0;    ///< no delimiter where there must be one

    [[nodiscard]] std::uint64_t bad() const noexcept { return badCrc + malformed + tooLong; }
};

/// Finds frames in a stream of any bytes. Holds one frame's bytes and no more; acts upon nothing before its CRC was
/// right; finds the first whole frame after junk that ended with a delimiter.
class FrameDecoder {
public:
    /// The next valid frame of `bytes`, from which it and all before it are taken; nothing when they are used up.
    /// `while (const auto frame = decoder.take(bytes)) ...`
    [[nodiscard]] std::optional<Frame> take(std::span<const std::uint8_t>& bytes) noexcept;
    [[nodiscard]] const LineCounts& counts() const noexcept { return counts_; }

private:
    [[nodiscard]] std::optional<Frame> finish() noexcept;
    [[nodiscard]] std::optional<std::size_t> unstuff() noexcept;

    std::array<std::uint8_t, kMaxStuffed> stuffed_{};
    std::array<std::uint8_t, kMaxStuffed> content_{};
    std::size_t held_ = 0;
    bool skipping_ = false;  // too long already
    LineCounts counts_;
};

/// A command's bytes, delimiter and a leading 00 included: the zero ends any junk before it.
/// `payload` (after the token): at most kMaxPayload - 1 bytes.
[[nodiscard]] std::vector<std::uint8_t> encodeCommand(Command command, std::uint8_t token,
                                                      std::span<const std::uint8_t> payload = {});

/// CRC-32/ISO-HDLC, zlib's.
[[nodiscard]] std::uint32_t crcOf(std::span<const std::uint8_t> bytes) noexcept;

}  // namespace tacto::sensorboard
