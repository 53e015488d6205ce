// DeviceSide.h - the device's side of the ScienceMode4 protocol: reads requests from payloads, writes answers.
//
// Source of all figures: resources/design/wire/sciencemode4.md.
//
// Thread-safety: pure functions.
#pragma once

#include "drivers/sciencemode/Acks.h"

namespace tacto::sciencemode {

[[nodiscard]] Point decodePoint(std::span<const std::uint8_t, 4> bytes) noexcept;
/// Returns nothing if the payload is not one that the driver builds.
[[nodiscard]] std::optional<LowLevelInit> readLowLevelInit(std::span<const std::uint8_t> payload) noexcept;
[[nodiscard]] std::optional<ChannelConfig> readChannelConfig(std::span<const std::uint8_t> payload) noexcept;

[[nodiscard]] Payload payloadOf(const ChannelConfigAck& ack) noexcept;
[[nodiscard]] Payload payloadOf(const StimStatusAck& ack) noexcept;
[[nodiscard]] Payload payloadOf(const DeviceIdAck& ack) noexcept;
[[nodiscard]] Payload payloadOf(const ExtendedVersionAck& ack) noexcept;

}  // namespace tacto::sciencemode
