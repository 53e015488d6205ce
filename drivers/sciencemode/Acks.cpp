#include "drivers/sciencemode/Acks.h"

#include <algorithm>

#include "core/base/Words.h"

namespace tacto::sciencemode {
namespace {

constexpr std::size_t kIdLength = 10;
constexpr std::size_t kPlaceLength = 3;  // result, place, measurement
constexpr std::size_t kMeasuredLength = kPlaceLength + 2 + 2 * kSamples;
constexpr std::size_t kVersionLength = 7;  // result and two versions; the firmware's hash follows
constexpr std::size_t kHashLength = 6;     // four bytes, the kind of hash, whether the hash is valid

tl::unexpected<Error> wrongLength(Command command, std::size_t length, std::string_view expected) {
    return fail(ErrorCode::Device, "the stimulator's answer to {} has {} bytes; {} were expected", nameOf(command),
                length, expected);
}

std::uint16_t wordAt(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
    return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

/// Returns the result of a payload if the result is not Ok.
std::optional<ResultCode> refusedWith(std::span<const std::uint8_t> payload) noexcept {
    if (payload.empty() || payload[0] == 0) return std::nullopt;
    return static_cast<ResultCode>(payload[0]);
}

constexpr Word<ResultCode> kMeanings[] = {
    {"no error", ResultCode::Ok},
    {"the transfer was garbled", ResultCode::Transfer},
    {"a parameter is out of its range", ResultCode::Parameter},
    {"the message does not follow the protocol", ResultCode::Protocol},
    {"its stimulation unit does not answer its controller", ResultCode::StimulatorTimeout},
    {"its stimulation is not initialised", ResultCode::NotInitialised},
    {"its high voltage is faulty", ResultCode::HighVoltage},
    {"an electrode is off", ResultCode::Electrode},
    {"it does not know the command", ResultCode::InvalidCommand},
    {"a pulse did not end in time", ResultCode::PulseTimeout},
    {"it is busy", ResultCode::Busy},
    {"the pulse did not reach its current: the impedance is too high, or an electrode is lifting",
     ResultCode::LowCurrent}};

}  // namespace

std::string_view meaningOf(ResultCode code) noexcept {
    return wordFor(kMeanings, code, "of an error that has no name");
}

tl::unexpected<Error> refusal(Command command, ResultCode code) {
    return fail(ErrorCode::Device, "the stimulator refused {} because {} (result {})", nameOf(command), meaningOf(code),
                static_cast<int>(code));
}

Result<ResultCode> readPlainAck(Command command, std::span<const std::uint8_t> payload) {
    if (payload.size() != 1) return wrongLength(command, payload.size(), "1");
    return static_cast<ResultCode>(payload[0]);
}

Result<void> readChannelConfigAck(std::span<const std::uint8_t> payload, ChannelConfigAck& into) {
    into.complete = into.measured = false;
    into.measurement = Measurement::None;
    if (payload.size() != 1 && payload.size() != kPlaceLength && payload.size() != kMeasuredLength) {
        return wrongLength(Command::ChannelConfig, payload.size(), "1, 3 or 261");
    }
    into.result = static_cast<ResultCode>(payload[0]);
    if (payload.size() == 1) {
        if (into.result != ResultCode::Ok) return {};
        return wrongLength(Command::ChannelConfig, payload.size(), "at least 3, for a pulse that succeeded,");
    }
    if (payload[2] > 3) {
        return fail(ErrorCode::Device, "the stimulator measured quantity {} of a pulse; 0 to 3 were expected",
                    payload[2]);
    }
    into.complete = true;
    into.channel = payload[1] & 0xF;
    into.connector = payload[1] >> 4;
    into.measurement = static_cast<Measurement>(payload[2]);
    into.measured = payload.size() == kMeasuredLength && into.measurement != Measurement::None;
    if (!into.measured) return {};
    into.sampleTime_us = wordAt(payload, kPlaceLength);
    for (std::size_t i = 0; i < kSamples; ++i) into.samples[i] = wordAt(payload, kPlaceLength + 2 + 2 * i);
    return {};
}

Result<StimStatusAck> readStimStatusAck(std::span<const std::uint8_t> payload) {
    if (const auto code = refusedWith(payload)) return refusal(Command::StimStatus, *code);
    if (payload.size() != 3) return wrongLength(Command::StimStatus, payload.size(), "3");
    if (payload[1] > 3) {
        return fail(ErrorCode::Device, "the stimulator is in state {}; 0 to 3 were expected", payload[1]);
    }
    return StimStatusAck{static_cast<Stimulation>(payload[1]), payload[2]};
}

Result<DeviceIdAck> readDeviceIdAck(std::span<const std::uint8_t> payload) {
    if (const auto code = refusedWith(payload)) return refusal(Command::DeviceId, *code);
    if (payload.size() != 1 + kIdLength) return wrongLength(Command::DeviceId, payload.size(), "11");
    DeviceIdAck ack;
    for (const auto byte : payload.subspan(1)) {
        if (byte == 0) break;
        if (byte < 0x20 || byte > 0x7E) {
            return fail(ErrorCode::Device,
                        "the stimulator's identity holds the byte {:02X}; printable ASCII was expected", byte);
        }
        ack.id += static_cast<char>(byte);
    }
    while (ack.id.ends_with(' ')) ack.id.pop_back();
    return ack;
}

std::string Version::text() const { return fmt::format("{}.{}.{}", major, minor, patch); }

Result<ExtendedVersionAck> readExtendedVersionAck(std::span<const std::uint8_t> payload) {
    if (const auto code = refusedWith(payload)) return refusal(Command::ExtendedVersion, *code);
    if (payload.size() != kVersionLength && payload.size() != kVersionLength + kHashLength) {
        return wrongLength(Command::ExtendedVersion, payload.size(), "7 or 13");
    }
    return ExtendedVersionAck{{payload[1], payload[2], payload[3]}, {payload[4], payload[5], payload[6]}};
}

}  // namespace tacto::sciencemode
