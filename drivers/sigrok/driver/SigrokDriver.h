// SigrokDriver.h - oscilloscopes through libsigrok: sigrok:demo, sigrok:rigol-ds:conn=tcp-raw/192.0.2.1/5555, ...
// How a URI is written is in ScopeUri.h.
//
// Thread-safety: as Driver.
#pragma once

#include <memory>

#include "core/devices/Driver.h"
#include "drivers/usb/UsbProvider.h"

namespace tacto {

/// Lists libsigrok's demo device, the USB instruments whose makers' oscilloscopes libsigrok drives (from what the
/// system knows of them; nothing is sent to any), and how one on the network is named. `usb` may be empty: none are
/// listed.
[[nodiscard]] std::unique_ptr<Driver> makeSigrokDriver(UsbProvider usb);

}  // namespace tacto
