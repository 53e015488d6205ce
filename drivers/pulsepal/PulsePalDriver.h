// PulsePalDriver.h - opens Pulse Pal 2 (Sanworks, USB 2341:003E), ± 10 V, for bench loads.
//
//   pulsepal:                    the only Pulse Pal that is plugged in
//   pulsepal:85736323838351F0    by its USB serial number
//   pulsepal:1-4.2               by its USB socket
//   pulsepal:?channel=3          output 1 to 4 (default 1)
//
// The ports' transports must set DTR (UsbBulkOptions::dataTerminalReady); otherwise the device's replies are lost.
//
// Thread-safety: as Driver.
#pragma once

#include <memory>

#include "core/devices/Driver.h"
#include "core/devices/TransportPorts.h"

namespace tacto {

inline constexpr std::uint16_t kPulsePalVendor = 0x2341;
inline constexpr std::uint16_t kPulsePalProduct = 0x003E;

/// `ports` lists the places where a Pulse Pal may be plugged in.
[[nodiscard]] std::unique_ptr<Driver> makePulsePalDriver(std::shared_ptr<TransportPorts> ports);

}  // namespace tacto
