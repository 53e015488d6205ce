// DeviceSide.h - the other half of the ScienceMode4 protocol: requests from payloads, and answers to payloads.
//
// Source of every figure: resources/design/wire/sciencemode4.md.
//
// Thread-safety: pure functions.
#pragma once

#include "drivers/sciencemode/Acks.h"

namespace tacto::sciencemode {

[[nodiscard]] Point decodePoint(std::span<const std::uint8_t, 4> bytes) noexcept;
/// Nothing when the payload is not one that the driver's builders make.
[[nodiscard]] std::optional<LowLevelInit> readLowLevelInit(std::span<const std::uint8_t> payload) noexcept;
[[nodiscard]] std::optional<ChannelConfig> readChannelConfig(std::span<const std::uint8_t> payload) noexcept;

[[nodiscard]] Payload payloadOf(const ChannelConfigAck& ack) noexcept;
[[nodiscard]] Payload payloadOf(const StimStatusAck& ack) noexcept;
[[nodiscard]] Payload payloadOf(const DeviceIdAck& ack) noexcept;
[[nodiscard]] Payload payloadOf(const ExtendedVersionAck& ack) noexcept;

}  // namespace tacto::sciencemode
