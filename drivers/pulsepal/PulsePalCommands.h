// PulsePalCommands.h - the commands to Pulse Pal 2 as bytes, and its answers. Each kind of value has its own type, so
// that a duration cannot be passed as a voltage, and each parameter's number is written only once.
//
// Source: firmware PulsePal_2_0_1.ino (sanworks/PulsePal), described in pulsepal2.md. Little-endian, no checksum; every
// command begins with D5.
//
// D5 52, continuous mode, is left out on purpose: outputs of this program end by themselves, and the order of the
// command's two arguments differs between firmware versions, so that "off" for one version is "on" for another.
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
inline constexpr Micros kCycle{50};      ///< the time step of the device
inline constexpr double kMaxVolts = 10;  ///< the output range is ± this voltage
inline constexpr std::uint16_t kZeroVolts = 32768;
inline constexpr std::uint32_t kMaxCycles = 72'000'000;  ///< 3600 s; the device's own menu allows no more

/// A command's bytes; the longest command has 9.
struct CommandBytes {
    std::array<std::uint8_t, 9> bytes{};
    std::size_t size = 0;
    [[nodiscard]] std::span<const std::uint8_t> view() const noexcept { return {bytes.data(), size}; }
};

/// An output channel, 1 to 4. Errors: InvalidArgument.
class Channel {
public:
    [[nodiscard]] static Result<Channel> of(int number);
    [[nodiscard]] std::uint8_t number() const noexcept { return number_; }
    /// Returns the channel's bit in a trigger's mask.
    [[nodiscard]] std::uint8_t mask() const noexcept { return static_cast<std::uint8_t>(1U << (number_ - 1)); }

private:
    explicit Channel(std::uint8_t number) : number_(number) {}
    std::uint8_t number_;
};

/// A duration in multiples of 50 µs.
class Cycles {
public:
    /// Errors: InvalidArgument naming `what` if the time is negative, not finite, longer than an hour, or off the 50 µs
    /// grid by more than the rounding error of decimal fractions in binary (1e-6 of a cycle).
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
/// Rounded toward 0 V, so that no phase exceeds the approved amplitude and opposite phases mirror each other. (The
/// maker's clients round upward, ceil((V + 10)/20 · 65535): the same for V ≤ 0, one step, 0.31 mV, more above.)
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
/// Returns the output voltage of a code; 0 V for 32768, the maker's zero, although the true output is 0.15 mV off.
[[nodiscard]] Volts voltsOf(std::uint16_t code) noexcept;

/// The parameters' numbers in the protocol.
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
    TriggerMode = 128,  ///< for this parameter the "channel" is a trigger input, 1 or 2
};
/// Returns the bytes of the parameter's value: 1, 2 or 4; 0 for an unknown parameter number.
[[nodiscard]] std::size_t sizeOf(Parameter parameter) noexcept;

// One function per kind of value; its type lists the parameters that it accepts.
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
/// Selects parametric trains instead of stored ones.
[[nodiscard]] CommandBytes noCustomTrain(Channel channel) noexcept;

[[nodiscard]] CommandBytes handshake() noexcept;
/// Starts the trains of the channels in `mask` (bit 0 = channel 1). Not acknowledged.
[[nodiscard]] CommandBytes trigger(std::uint8_t mask) noexcept;
/// Ends all trains. Not acknowledged.
[[nodiscard]] CommandBytes abort() noexcept;
/// Two aborts in one transfer: the device takes one command every 50 µs. A trigger that came just before the first
/// abort starts its train after it; the second abort ends that train.
[[nodiscard]] CommandBytes abortTwice() noexcept;
[[nodiscard]] CommandBytes disconnect() noexcept;
/// Sets the six characters on the device's display, padded with blanks.
[[nodiscard]] CommandBytes clientName(std::string_view name) noexcept;

/// The device's answer to a parameter command.
inline constexpr std::uint8_t kDone = 0x01;

struct Handshake {
    std::uint32_t firmware = 0;
};
inline constexpr std::size_t kHandshakeSize = 5;
/// Errors: ParseError for a wrong length or first byte; Unsupported unless the firmware is a known one of Pulse Pal 2
/// (20, 21): model 1 has 8-bit voltages in the same places.
[[nodiscard]] Result<Handshake> readHandshake(std::span<const std::uint8_t> reply);

}  // namespace tacto::pulsepal
