// HidBackend.h - a way to find and open HID devices: hidapi over hidraw, or a fake in tests.
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
    std::string serial;  ///< empty where the device has none
    std::string name;    ///< as the device says; empty if it says none
    std::string path;    ///< "/dev/hidraw0"
    Usage usage = 0;     ///< of a top-level collection; 0 where hidapi does not know
    bool permitted = true;

    /// "HID device 054c:0ce6 at /dev/hidraw0 (serial 17)", for messages.
    [[nodiscard]] std::string label() const;
    /// Why it cannot be opened, and what helps, in a sentence; empty for a permitted device.
    [[nodiscard]] std::string obstacle() const;
};

class HidBackend {
public:
    virtual ~HidBackend() = default;
    /// Everything that is plugged in, including what may not be opened; a device with several top-level collections
    /// comes several times, with the same path.
    [[nodiscard]] virtual std::vector<HidDeviceInfo> devices() const = 0;
    /// The report descriptor, without opening the device. Errors: NotFound, Io.
    [[nodiscard]] virtual Result<std::vector<std::uint8_t>> descriptor(const HidDeviceInfo& info) const = 0;
    /// Errors: Io (not permitted, in use), Device.
    [[nodiscard]] virtual Result<std::unique_ptr<HidPort>> open(const HidDeviceInfo& info) const = 0;
};

}  // namespace tacto::hid
