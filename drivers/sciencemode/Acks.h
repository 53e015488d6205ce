// Acks.h - what a ScienceMode4 device answers: typed results, from payloads.
//
// A parser believes no length: a payload of another size than its ack has is refused.
//
// Source of every figure: resources/design/wire/sciencemode4.md.
//
// Thread-safety: pure functions; nothing allocates on success.
#pragma once

#include <string>

#include "drivers/sciencemode/ScienceModeCommands.h"

namespace tacto::sciencemode {

/// The first payload byte of an ack. Devices may send others; see meaningOf().
enum class ResultCode : std::uint8_t {
    Ok = 0,
    Transfer = 1,
    Parameter = 2,
    Protocol = 3,
    StimulatorTimeout = 4,
    NotInitialised = 7,
    HighVoltage = 8,
    Electrode = 10,
    InvalidCommand = 11,
    PulseTimeout = 16,
    Busy = 21,
    LowCurrent = 28,
};
/// The cause of the failure, half a sentence for refusal().
[[nodiscard]] std::string_view meaningOf(ResultCode code) noexcept;
/// The error for an ack whose result is not Ok, code Device: "the stimulator refused LL_INIT: ...".
[[nodiscard]] tl::unexpected<Error> refusal(Command command, ResultCode code);

inline constexpr std::size_t kSamples = 128;

/// The answer to LL_CHANNEL_CONFIG: what the device measured during its own pulse.
struct ChannelConfigAck {
    ResultCode result = ResultCode::Ok;
    bool complete = false;  ///< false: a result alone, nothing below is stated
    int channel = 0;
    int connector = 0;
    Measurement measurement = Measurement::None;
    std::uint16_t sampleTime_us = 0;                ///< it is not verified what this counts: see ReadBack.h
    bool measured = false;                          ///< samples follow
    std::array<std::uint16_t, kSamples> samples{};  ///< magnitudes in 0.01 mA or 0.01 V; the sign is lost
};

enum class Stimulation : std::uint8_t { None = 0, LowLevel = 1, MidLevel = 2, MidLevelRunning = 3 };
struct StimStatusAck {
    Stimulation status = Stimulation::None;
    std::uint8_t highVoltage = 0;
};

/// The beginning of an emulated device's identity. It makes nothing simulated: the address does. Where that says so and
/// another identity answers, the device is not opened (H4).
inline constexpr std::string_view kEmulatedId = "EMU";

struct DeviceIdAck {
    std::string id;  ///< 10 characters, trailing blanks removed
};

struct Version {
    std::uint8_t major = 0, minor = 0, patch = 0;
    [[nodiscard]] std::string text() const;
    bool operator==(const Version&) const = default;
};
struct ExtendedVersionAck {
    Version firmware;
    Version protocol;
};

/// Errors of each: Device for a payload that is not this ack.
[[nodiscard]] Result<ResultCode> readPlainAck(Command command, std::span<const std::uint8_t> payload);
/// A result alone, or a result, a place and a measurement without samples, are acks too (an error, or no measurement).
[[nodiscard]] Result<void> readChannelConfigAck(std::span<const std::uint8_t> payload, ChannelConfigAck& into);
// Of these, a result that is not Ok is a refusal().
[[nodiscard]] Result<StimStatusAck> readStimStatusAck(std::span<const std::uint8_t> payload);
[[nodiscard]] Result<DeviceIdAck> readDeviceIdAck(std::span<const std::uint8_t> payload);
[[nodiscard]] Result<ExtendedVersionAck> readExtendedVersionAck(std::span<const std::uint8_t> payload);

}  // namespace tacto::sciencemode
