// Wire.h - the host's encoder and decoder for frames of the sensor board protocol
// (resources/firmware/sensor_board/PROTOCOL.md, sections 2, 3 and 7).
//
//   COBS( version | type | payload | CRC-32 ) | 00        content at most 254 bytes
//
// Written from the specification and not from the firmware's C code, so that each tests the other.
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

inline constexpr std::uint8_t kVersion = 1;         ///< of every frame but those of a board that encodes
inline constexpr std::uint8_t kEncoderVersion = 2;  ///< of these; the newest that is known here
inline constexpr std::size_t kMaxContent = 254;     ///< bytes from version to CRC
inline constexpr std::size_t kMinContent = 6;       ///< bytes of version, type and CRC
inline constexpr std::size_t kMaxStuffed = 255;     ///< bytes before the delimiter
inline constexpr std::size_t kMaxPayload = kMaxContent - kMinContent;

enum class Command : std::uint8_t {
    Hello = 0x01,
    GetConfiguration = 0x02,
    SetConfiguration = 0x03,
    GetCalibration = 0x04,
    Start = 0x05,
    Stop = 0x06,
    GetStatus = 0x07,
    GetEncoder = 0x08,
    SetEncoder = 0x09,
};

enum class Reply : std::uint8_t {
    Identity = 0x41,
    Configuration = 0x42,
    Calibration = 0x44,
    Done = 0x45,
    Status = 0x46,
    Encoder = 0x47,
    Refused = 0x4F,
    Data = 0x50,
    Reading = 0x51,
    Train = 0x52,
    Silent = 0x53,
};

/// Returns the version that brought this type of frame, and that each of its frames has.
[[nodiscard]] constexpr std::uint8_t versionOf(Command command) noexcept {
    return command == Command::GetEncoder || command == Command::SetEncoder ? kEncoderVersion : kVersion;
}
[[nodiscard]] constexpr std::uint8_t versionOf(Reply reply) noexcept {
    return reply == Reply::Encoder || reply >= Reply::Reading ? kEncoderVersion : kVersion;
}

/// A frame with a correct CRC. `payload` points into the decoder and is valid until its next call.
struct Frame {
    std::uint8_t version = 0;
    std::uint8_t type = 0;
    std::span<const std::uint8_t> payload;

    [[nodiscard]] bool is(Reply reply) const noexcept {
        return version == versionOf(reply) && type == static_cast<std::uint8_t>(reply);
    }
};

/// Counts of one line; they only grow.
struct LineCounts {
    std::uint64_t bytes = 0;
    std::uint64_t frames = 0;     ///< frames with a correct CRC
    std::uint64_t badCrc = 0;     ///< complete frames with a wrong CRC
    std::uint64_t malformed = 0;  ///< frames that were no valid COBS, or too short
    std::uint64_t tooLong = 0;    ///< no delimiter where one must come

    [[nodiscard]] std::uint64_t bad() const noexcept { return badCrc + malformed + tooLong; }
};

/// Finds frames in a stream of arbitrary bytes. Stores the bytes of one frame at most; uses a frame only after its CRC
/// was checked; after junk that ends with a delimiter, finds the next complete frame.
class FrameDecoder {
public:
    /// Removes bytes from the front of `bytes` up to the next valid frame and returns the frame; nothing if all are
    /// used up: `while (const auto frame = decoder.take(bytes)) ...`
    [[nodiscard]] std::optional<Frame> take(std::span<const std::uint8_t>& bytes) noexcept;
    [[nodiscard]] const LineCounts& counts() const noexcept { return counts_; }

private:
    [[nodiscard]] std::optional<Frame> finish() noexcept;
    [[nodiscard]] std::optional<std::size_t> unstuff() noexcept;

    std::array<std::uint8_t, kMaxStuffed> stuffed_{};
    std::array<std::uint8_t, kMaxStuffed> content_{};
    std::size_t held_ = 0;
    bool skipping_ = false;  // true if the frame is already too long
    LineCounts counts_;
};

/// Returns a command's bytes with the delimiter and a leading 00, which ends any junk before it. `payload` (after the
/// token): at most kMaxPayload - 1 bytes.
[[nodiscard]] std::vector<std::uint8_t> encodeCommand(Command command, std::uint8_t token,
                                                      std::span<const std::uint8_t> payload = {});

/// Returns the CRC-32/ISO-HDLC, as zlib does.
[[nodiscard]] std::uint32_t crcOf(std::span<const std::uint8_t> bytes) noexcept;

}  // namespace tacto::sensorboard
