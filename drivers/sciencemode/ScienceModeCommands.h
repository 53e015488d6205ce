// ScienceModeCommands.h - the requests to a ScienceMode4 device: typed values to payloads.
//
// A builder refuses values that the protocol cannot carry (a wrapped field would be a wrong pulse); it never rounds and
// never clamps.
//
// Source of all figures: resources/design/wire/sciencemode4.md.
//
// Thread-safety: pure functions; nothing allocates on success.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/base/Units.h"
#include "drivers/sciencemode/Frame.h"

namespace tacto::sciencemode {

enum class Command : std::uint16_t {
    LowLevelInit = 0,
    ChannelConfig = 2,
    LowLevelStop = 4,
    MidLevelStop = 34,
    DeviceId = 52,
    Reset = 58,
    StimStatus = 62,
    GeneralError = 66,
    UnknownCommand = 67,
    ExtendedVersion = 68,
};
[[nodiscard]] std::string_view nameOf(Command command) noexcept;  // the vendor's name: "LL_CHANNEL_CONFIG"
/// Returns the command number of the answer to `command`.
[[nodiscard]] constexpr std::uint16_t ackOf(Command command) noexcept {
    return static_cast<std::uint16_t>(static_cast<std::uint16_t>(command) + 1);
}

enum class HighVoltage : std::uint8_t { Default = 0, Off = 1, V30 = 2, V60 = 3, V90 = 4, V120 = 5, V150 = 6 };
enum class Measurement : std::uint8_t { None = 0, Current = 1, Voltage = 2, Source = 3 };

inline constexpr double kMaxCurrent_mA = 130;
inline constexpr double kCurrentStep_mA = 0.5;
inline constexpr int kMinPoint_us = 10;
inline constexpr int kMaxPoint_us = 4095;  // largest value of 12 bits
inline constexpr std::size_t kMaxPoints = 16;
inline constexpr std::size_t kChannels = 4;  // 2 bits, plus one bit for the connector

/// A stretch of constant current. Several points make a pulse.
struct Point {
    Micros time{0};        ///< whole µs, 10 to 4095
    Milliamps current{0};  ///< multiples of 0.5 mA, −130 to 130; the sign is the phase's direction
    bool operator==(const Point&) const = default;
};

/// The points of one pulse.
struct Points {
    std::array<Point, kMaxPoints> items{};
    std::size_t count = 0;
    [[nodiscard]] std::span<const Point> span() const noexcept { return {items.data(), count}; }
    [[nodiscard]] Micros duration() const noexcept;
    [[nodiscard]] bool add(const Point& point) noexcept;  ///< returns false if full
};

struct Payload {
    std::array<std::uint8_t, kMaxPayload> bytes;  // not cleared: only the first `size` bytes are valid
    std::size_t size = 0;
    [[nodiscard]] std::span<const std::uint8_t> view() const noexcept { return {bytes.data(), size}; }
    void push(unsigned byte) noexcept { bytes[size++] = static_cast<std::uint8_t>(byte & 0xFFU); }
};

struct LowLevelInit {
    HighVoltage highVoltage = HighVoltage::Default;
    Measurement measurement = Measurement::None;
    bool operator==(const LowLevelInit&) const = default;
};
struct ChannelConfig {
    int channel = 0;    ///< 0 to 3
    int connector = 0;  ///< 0 yellow, 1 green
    bool execute = true;
    Points points;
};
using PointBytes = std::array<std::uint8_t, 4>;
/// Errors: InvalidArgument naming the value and its range.
[[nodiscard]] Result<PointBytes> encodePoint(const Point& point);

[[nodiscard]] Payload payloadOf(const LowLevelInit& request) noexcept;
[[nodiscard]] Result<Payload> payloadOf(const ChannelConfig& request);

}  // namespace tacto::sciencemode
