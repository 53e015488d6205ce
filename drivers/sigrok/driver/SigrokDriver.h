// SigrokDriver.h - oscilloscopes through libsigrok: sigrok:demo, sigrok:rigol-ds:conn=tcp-raw/192.0.2.1/5555, ...
// ScopeUri.h describes how to write a URI.
//
// Thread-safety: as Driver.
#pragma once

#include <memory>

#include "core/devices/Driver.h"
#include "drivers/usb/UsbProvider.h"

namespace tacto {

/// Lists libsigrok's demo device, the USB oscilloscopes that libsigrok has a driver for (as the system knows them;
/// nothing is sent to them), and a sample name for one on the network. If `usb` is empty, no USB oscilloscopes are
/// listed.
[[nodiscard]] std::unique_ptr<Driver> makeSigrokDriver(UsbProvider usb);

}  // namespace tacto
