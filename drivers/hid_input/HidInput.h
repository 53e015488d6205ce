// HidInput.h - game pads and foot switches over hidraw. The kernel's own driver keeps the device, which hidraw shares.
//
// Two devices of the same vendor, product and serial number (or none) that are plugged in cannot be told apart when one
// is plugged in again, so neither can be used (H4). A device that was unplugged is opened again when one of the same
// identity and report descriptor is plugged in; one like it that was there when it went stays another (H4). One that
// types keys is a keyboard, and is not listed.
//
// Thread-safety: as ButtonDevices.
#pragma once

#include <memory>

#include "core/devices/ButtonDevice.h"
#include "drivers/hid_massager/HidBackend.h"

namespace tacto::hid {

[[nodiscard]] std::shared_ptr<const ButtonDevices> makeHidInput(std::shared_ptr<const HidBackend> backend);
/// The devices of this computer.
[[nodiscard]] std::shared_ptr<const ButtonDevices> systemHidInput();

}  // namespace tacto::hid
