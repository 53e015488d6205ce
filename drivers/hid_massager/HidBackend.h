// HidBackend.h - the interface to find and open HID devices: hidapi over hidraw, or a fake in tests.
//
// Thread-safety: any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/hid_massager/HidDescriptor.h"
#include "drivers/hid_massager/HidPort.h"

namespace tacto::hid {

struct HidDeviceInfo {
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    std::string serial;  ///< empty if the device has none
    std::string name;    ///< as the device states it; may be empty
    std::string path;    ///< "/dev/hidraw0"
    Usage usage = 0;     ///< usage of a top-level collection; 0 if hidapi does not know
    bool permitted = true;

    /// Returns "HID device 054c:0ce6 at /dev/hidraw0 (serial 17)", for messages.
    [[nodiscard]] std::string label() const;
    /// Says in a sentence why this user cannot open the device and what helps; empty for a permitted device.
    [[nodiscard]] std::string obstacle() const;
};

class HidBackend {
public:
    virtual ~HidBackend() = default;
    /// Returns all plugged-in devices, including those that this user may not open. A device with several top-level
    /// collections appears several times, with the same path.
    [[nodiscard]] virtual std::vector<HidDeviceInfo> devices() const = 0;
    /// Returns the report descriptor without opening the device. Errors: NotFound, Io.
    [[nodiscard]] virtual Result<std::vector<std::uint8_t>> descriptor(const HidDeviceInfo& info) const = 0;
    /// Errors: Io (not permitted, in use), Device.
    [[nodiscard]] virtual Result<std::unique_ptr<HidPort>> open(const HidDeviceInfo& info) const = 0;
};

}  // namespace tacto::hid
