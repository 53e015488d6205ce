// PulsePalCommands.h - commands to Pulse Pal 2, as bytes, and its answers. Every command is a type of its own kind of
// value, so that a duration cannot stand in a voltage's slot, and each parameter's number is written down once.
//
// Source: firmware PulsePal_2_0_1.ino (sanworks/PulsePal), by pulsepal2.md. Little-endian, no checksum;
// every command begins with D5.
//
// D5 52, continuous mode, is not here on purpose: outputs of this program end by themselves, and the order of its two
// arguments differs between firmware versions, so that "off" for one is "on" for another.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/Result.h"
#include "core/base/Units.h"

namespace tacto::pulsepal {

inline constexpr std::uint8_t kStart = 0xD5;
inline constexpr int kChannels = 4;
inline constexpr Micros kCycle{50};      ///< everything happens on this grid
inline constexpr double kMaxVolts = 10;  ///< output range is ± this
inline constexpr std::uint16_t kZeroVolts = 32768;
inline constexpr std::uint32_t kMaxCycles = 72'000'000;  ///< 3600 s; the device's own menu allows no more

/// A command's bytes; none is longer.
struct CommandBytes {
    std::array<std::uint8_t, 9> bytes{};
    std::size_t size = 0;
    [[nodiscard]] std::span<const std::uint8_t> view() const noexcept { return {bytes.data(), size}; }
};

/// An output, 1 to 4. Errors: InvalidArgument.
class Channel {
public:
    [[nodiscard]] static Result<Channel> of(int number);
    [[nodiscard]] std::uint8_t number() const noexcept { return number_; }
    /// The channel's bit in a trigger's mask.
    [[nodiscard]] std::uint8_t mask() const noexcept { return static_cast<std::uint8_t>(1U << (number_ - 1)); }

private:
    explicit Channel(std::uint8_t number) : number_(number) {}
    std::uint8_t number_;
};

/// A multiple of 50 µs.
class Cycles {
public:
    /// Errors: InvalidArgument for a time that is negative, not finite, longer than an hour, or off the grid by more
    /// than what decimal fractions lose in binary (1e-6 of a cycle); `what` names it.
    [[nodiscard]] static Result<Cycles> of(Micros time, const char* what);
    [[nodiscard]] static constexpr Cycles exactly(std::uint32_t count) noexcept { return Cycles(count); }
    [[nodiscard]] constexpr std::uint32_t count() const noexcept { return count_; }
    [[nodiscard]] constexpr Micros time() const noexcept { return kCycle * static_cast<double>(count_); }

private:
    constexpr explicit Cycles(std::uint32_t count) : count_(count) {}
    std::uint32_t count_;
};

/// A voltage as the converter's 16 bits: 0 is -10 V, 65535 is +10 V, 32768 stands for 0 V.
///
/// Rounded toward 0 V, so that no phase exceeds what was approved and opposite phases mirror each other. (The maker's
/// clients round upward, ceil((V + 10)/20 · 65535): the same for V ≤ 0, one step, 0.31 mV, more above.)
class VoltageCode {
public:
    /// Errors: InvalidArgument outside ± 10 V, or not finite.
    [[nodiscard]] static Result<VoltageCode> of(Volts volts);
    [[nodiscard]] static constexpr VoltageCode zero() noexcept { return VoltageCode(kZeroVolts); }
    [[nodiscard]] constexpr std::uint16_t code() const noexcept { return code_; }
    [[nodiscard]] Volts volts() const noexcept;

private:
    constexpr explicit VoltageCode(std::uint16_t code) : code_(code) {}
    std::uint16_t code_;
};
/// The output for a code; 0 V for 32768, the maker's zero, which is 0.15 mV off.
[[nodiscard]] Volts voltsOf(std::uint16_t code) noexcept;

/// The parameters' numbers on the wire.
enum class Parameter : std::uint8_t {
    Biphasic = 1,
    Phase1Voltage = 2,
    Phase2Voltage = 3,
    Phase1Duration = 4,
    InterPhaseInterval = 5,
    Phase2Duration = 6,
    InterPulseInterval = 7,
    BurstDuration = 8,
    InterBurstInterval = 9,
    TrainDuration = 10,
    TrainDelay = 11,
    LinkTrigger1 = 12,
    LinkTrigger2 = 13,
    CustomTrain = 14,
    CustomTarget = 15,
    CustomLoop = 16,
    RestingVoltage = 17,
    TriggerMode = 128,  ///< here the "channel" is a trigger input, 1 or 2
};
/// Bytes of its value: 1, 2 or 4; 0 for a number that is not a parameter.
[[nodiscard]] std::size_t sizeOf(Parameter parameter) noexcept;

// One function per kind of value; each takes only the parameters of its kind, which are named in its type.
enum class Switch : std::uint8_t {
    Biphasic = 1,
    LinkTrigger1 = 12,
    LinkTrigger2 = 13,
    CustomTarget = 15,
    CustomLoop = 16
};
enum class Voltage : std::uint8_t { Phase1 = 2, Phase2 = 3, Resting = 17 };
enum class Duration : std::uint8_t {
    Phase1 = 4,
    InterPhase = 5,
    Phase2 = 6,
    InterPulse = 7,
    Burst = 8,
    InterBurst = 9,
    Train = 10,
    TrainDelay = 11,
};
[[nodiscard]] CommandBytes set(Switch what, Channel channel, bool on) noexcept;
[[nodiscard]] CommandBytes set(Voltage what, Channel channel, VoltageCode value) noexcept;
[[nodiscard]] CommandBytes set(Duration what, Channel channel, Cycles value) noexcept;
/// Parametric trains, not stored ones.
[[nodiscard]] CommandBytes noCustomTrain(Channel channel) noexcept;

[[nodiscard]] CommandBytes handshake() noexcept;
/// Starts the trains of the channels in `mask` (bit 0 = channel 1). Not acknowledged.
[[nodiscard]] CommandBytes trigger(std::uint8_t mask) noexcept;
/// Ends all trains. Not acknowledged.
[[nodiscard]] CommandBytes abort() noexcept;
/// Two aborts in one transfer: the device takes one command every 50 µs, and a trigger that came just before the first
/// one starts its train behind it, which the second one ends.
[[nodiscard]] CommandBytes abortTwice() noexcept;
[[nodiscard]] CommandBytes disconnect() noexcept;
/// Six characters for its display, padded with blanks.
[[nodiscard]] CommandBytes clientName(std::string_view name) noexcept;

/// The device's answer to a parameter.
inline constexpr std::uint8_t kDone = 0x01;

struct Handshake {
    std::uint32_t firmware = 0;
};
inline constexpr std::size_t kHandshakeSize = 5;
/// Errors: ParseError for another length or first byte; Unsupported for a firmware that is not a Pulse Pal 2's known
/// one (20, 21): model 1 has 8-bit voltages in the same slots.
[[nodiscard]] Result<Handshake> readHandshake(std::span<const std::uint8_t> reply);

}  // namespace tacto::pulsepal
