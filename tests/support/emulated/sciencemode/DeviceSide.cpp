#include "tests/support/emulated/sciencemode/DeviceSide.h"

#include <cmath>

namespace tacto::sciencemode {

namespace {

constexpr int kNoCurrent = 300;        // the code for 0 mA in the protocol
constexpr std::size_t kIdBytes = 10;   // bytes of an identity
constexpr std::size_t kHashBytes = 6;  // four bytes, the kind of hash, whether it is valid

/// Reads points from the front of `bytes` and moves `bytes` past them.
std::optional<Points> takePoints(std::span<const std::uint8_t>& bytes, std::size_t count) noexcept {
    if (bytes.size() < 4 * count) return std::nullopt;
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        const auto point = decodePoint(bytes.first<4>());
        bytes = bytes.subspan(4);
        if (point.time.count() < kMinPoint_us || !(std::abs(point.current.value()) <= kMaxCurrent_mA)) {
            return std::nullopt;
        }
        static_cast<void>(points.add(point));  // never full: callers ask for at most 16
    }
    return points;
}

}  // namespace

Point decodePoint(std::span<const std::uint8_t, 4> bytes) noexcept {
    const int t = (bytes[0] << 4) | (bytes[1] >> 4);
    const int c = ((bytes[1] & 0xF) << 6) | (bytes[2] >> 2);
    return {Micros(t), Milliamps((c - kNoCurrent) * kCurrentStep_mA)};
}

std::optional<LowLevelInit> readLowLevelInit(std::span<const std::uint8_t> payload) noexcept {
    if (payload.size() != 1) return std::nullopt;
    const unsigned voltage = (payload[0] >> 1U) & 7U;
    const unsigned measurement = (payload[0] >> 4U) & 7U;
    if (voltage > 6 || measurement > 3 || (payload[0] & 0x81U) != 0) return std::nullopt;
    return LowLevelInit{static_cast<HighVoltage>(voltage), static_cast<Measurement>(measurement)};
}

std::optional<ChannelConfig> readChannelConfig(std::span<const std::uint8_t> payload) noexcept {
    if (payload.empty()) return std::nullopt;
    const unsigned head = payload[0];
    auto rest = payload.subspan(1);
    const auto points = takePoints(rest, (head & 0xFU) + 1);
    if (!points || !rest.empty()) return std::nullopt;
    return ChannelConfig{static_cast<int>((head >> 5U) & 3U), static_cast<int>((head >> 4U) & 1U), (head & 0x80U) != 0,
                         *points};
}

Payload payloadOf(const ChannelConfigAck& ack) noexcept {
    Payload payload;
    payload.push(static_cast<unsigned>(ack.result));
    if (!ack.complete) return payload;
    payload.push(static_cast<unsigned>(ack.channel) | static_cast<unsigned>(ack.connector) << 4U);
    payload.push(static_cast<unsigned>(ack.measurement));
    if (!ack.measured) return payload;
    payload.push(static_cast<unsigned>(ack.sampleTime_us) >> 8U);
    payload.push(ack.sampleTime_us);
    for (const auto sample : ack.samples) {
        payload.push(static_cast<unsigned>(sample) >> 8U);
        payload.push(sample);
    }
    return payload;
}

Payload payloadOf(const StimStatusAck& ack) noexcept {
    Payload payload;
    payload.push(static_cast<unsigned>(ResultCode::Ok));
    payload.push(static_cast<unsigned>(ack.status));
    payload.push(ack.highVoltage);
    return payload;
}

Payload payloadOf(const DeviceIdAck& ack) noexcept {
    Payload payload;
    payload.push(static_cast<unsigned>(ResultCode::Ok));
    for (std::size_t i = 0; i < kIdBytes; ++i) {
        payload.push(i < ack.id.size() ? static_cast<unsigned char>(ack.id[i]) : ' ');
    }
    return payload;
}

Payload payloadOf(const ExtendedVersionAck& ack) noexcept {
    Payload payload;
    payload.push(static_cast<unsigned>(ResultCode::Ok));
    for (const auto& version : {ack.firmware, ack.protocol}) {
        payload.push(version.major);
        payload.push(version.minor);
        payload.push(version.patch);
    }
    for (std::size_t i = 0; i < kHashBytes; ++i) payload.push(0);
    return payload;
}

}  // namespace tacto::sciencemode
