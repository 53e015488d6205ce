// HidDriver.h - vibration devices as massagers, by the scheme "hid".
//
//   hid:                                  the only one that is plugged in
//   hid:054c:0ce6                         by vendor and product, as lsusb prints them
//   hid:054c:0ce6?serial=1234             one of several
//   hid:054c:0ce6?at=/dev/hidraw3         one of several that share their serial number or have none, by its node
//   hid:0b49:064f?at=1-2                  or, for a Trance Vibrator, by its USB socket
//   hid:1234:5678?template=dualsense      as this template says (its name, or a path to a file ending in .json)
//   hid:0b49:064f                         the Trance Vibrator
//
// What a device takes is found in this order: `template=`, the template that names its vendor and product, the Haptics
// page of its own report descriptor. A template must fit the device's descriptor, or the device is refused (H4).
//
// An address that is listed, or given as a choice, opens exactly that device.
// A device that is plugged in and may not be opened is listed with the sentence that helps.
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
    UsbProvider usb = {};             ///< opens the Trance Vibrator; empty: none
};

/// The real devices of this computer.
[[nodiscard]] HidDriverParts systemHid(std::filesystem::path templates, UsbProvider usb);

[[nodiscard]] std::unique_ptr<Driver> makeHidDriver(HidDriverParts parts);

}  // namespace tacto::hid
