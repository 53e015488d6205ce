// Acks.h - parses a ScienceMode4 device's answers: payloads to typed results.
//
// No parser trusts a length: a payload whose size does not match its ack is refused.
//
// Source of all figures: resources/design/wire/sciencemode4.md.
//
// Thread-safety: pure functions; nothing allocates on success.
#pragma once

#include <string>

#include "drivers/sciencemode/ScienceModeCommands.h"

namespace tacto::sciencemode {

/// The first payload byte of an ack. Devices may send other values; see meaningOf().
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
/// Returns the cause of the failure as half a sentence for refusal().
[[nodiscard]] std::string_view meaningOf(ResultCode code) noexcept;
/// Returns the error (code Device) for an ack that is not Ok: "the stimulator refused LL_INIT: ...".
[[nodiscard]] tl::unexpected<Error> refusal(Command command, ResultCode code);

inline constexpr std::size_t kSamples = 128;

/// The answer to LL_CHANNEL_CONFIG: the device's measurement during its own pulse.
struct ChannelConfigAck {
    ResultCode result = ResultCode::Ok;
    bool complete = false;  ///< false: only the result is stated, nothing below
    int channel = 0;
    int connector = 0;
    Measurement measurement = Measurement::None;
    std::uint16_t sampleTime_us = 0;                ///< its meaning is unverified on hardware: see ReadBack.h
    bool measured = false;                          ///< true if the ack contains samples
    std::array<std::uint16_t, kSamples> samples{};  ///< magnitudes in 0.01 mA or 0.01 V, without sign
};

enum class Stimulation : std::uint8_t { None = 0, LowLevel = 1, MidLevel = 2, MidLevelRunning = 3 };
struct StimStatusAck {
    Stimulation status = Stimulation::None;
    std::uint8_t highVoltage = 0;
};

/// How an emulated device's identity begins. Only the address marks a device as simulated; if the address says
/// "emulated" and another identity answers, the device is not opened (H4).
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

/// Errors of each function: Device if the payload is not this ack.
[[nodiscard]] Result<ResultCode> readPlainAck(Command command, std::span<const std::uint8_t> payload);
/// A result alone (an error), or a result, place and measurement without samples (no measurement), are valid acks too.
[[nodiscard]] Result<void> readChannelConfigAck(std::span<const std::uint8_t> payload, ChannelConfigAck& into);
// In these, a result that is not Ok is the error refusal().
[[nodiscard]] Result<StimStatusAck> readStimStatusAck(std::span<const std::uint8_t> payload);
[[nodiscard]] Result<DeviceIdAck> readDeviceIdAck(std::span<const std::uint8_t> payload);
[[nodiscard]] Result<ExtendedVersionAck> readExtendedVersionAck(std::span<const std::uint8_t> payload);

}  // namespace tacto::sciencemode
