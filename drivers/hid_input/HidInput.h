// HidInput.h - game pads and foot switches over hidraw, which shares the device with the kernel's own driver.
//
// If two plugged-in devices have the same vendor, product and serial number (or none), they cannot be told apart after
// a re-plug, so neither can be used (H4). An unplugged device is opened again when a device with the same identity and
// report descriptor is plugged in; a similar device that was there when ours went is never taken for it (H4). A device
// that types keys is a keyboard and is not listed.
//
// Thread-safety: as ButtonDevices.
#pragma once

#include <memory>

#include "core/devices/ButtonDevice.h"
#include "drivers/hid_massager/HidBackend.h"

namespace tacto::hid {

[[nodiscard]] std::shared_ptr<const ButtonDevices> makeHidInput(std::shared_ptr<const HidBackend> backend);
/// Returns the devices of this computer.
[[nodiscard]] std::shared_ptr<const ButtonDevices> systemHidInput();

}  // namespace tacto::hid
