// HidDriver.h - opens vibration devices as massagers, with the URI scheme "hid".
//
//   hid:                                  the only massager that is plugged in
//   hid:054c:0ce6                         by vendor and product, as lsusb prints them
//   hid:054c:0ce6?serial=1234             one of several
//   hid:054c:0ce6?at=/dev/hidraw3         one of several with the same serial number or none, by its device node
//   hid:0b49:064f?at=1-2                  the same for a Trance Vibrator, by its USB socket
//   hid:1234:5678?template=dualsense      described by this template (its name, or a path to a file ending in .json)
//   hid:0b49:064f                         the Trance Vibrator
//
// The reports of a device are taken from the first of these: `template=`, the template that names its vendor and
// product, the Haptics page of its report descriptor. A device that the template does not fit is refused (H4).
//
// Each listed URI, and each URI offered as a choice, opens exactly one device.
// A plugged-in device that this user may not open is listed with a sentence that says what helps.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/devices/Driver.h"
#include "drivers/hid_massager/HidBackend.h"
#include "drivers/usb/UsbProvider.h"

namespace tacto::hid {

struct HidDriverParts {
    std::shared_ptr<const HidBackend> backend;
    std::filesystem::path templates;  ///< the folder resources/massagers
    UsbProvider usb = {};             ///< used to open the Trance Vibrator; empty: none
};

/// Returns the parts for the real devices of this computer.
[[nodiscard]] HidDriverParts systemHid(std::filesystem::path templates, UsbProvider usb);

[[nodiscard]] std::unique_ptr<Driver> makeHidDriver(HidDriverParts parts);

}  // namespace tacto::hid
