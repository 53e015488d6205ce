// HidapiBackend.h - HID devices through hidapi. Debian's two builds of it, over hidraw and over libusb, export the same
// names; the second is linked with its names changed (CMakeLists.txt), so that one program has both.
//
// hidraw leaves the device to the kernel's driver as well; libusb takes it away from that until it is closed.
#pragma once

#include <memory>

#include "drivers/hid_massager/HidBackend.h"

namespace tacto::hid {

[[nodiscard]] std::shared_ptr<const HidBackend> hidrawBackend();     // name "hidraw"
[[nodiscard]] std::shared_ptr<const HidBackend> libusbHidBackend();  // name "libusb"

}  // namespace tacto::hid
