// UsbDeviceInfo.h - what can be known of a USB device without opening it.
//
// Thread-safety: values; describe() any thread.
#pragma once

#include <cstdint>
#include <string>

struct libusb_device;

namespace tacto {

/// Identifies a device, also after it was plugged into another socket.
struct UsbIdentity {
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    std::string serial = {};  ///< empty: any serial number
    friend bool operator==(const UsbIdentity&, const UsbIdentity&) = default;
};

struct UsbDeviceInfo {
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    std::string serial;  ///< empty if the device has none
    std::string maker;   ///< as the device states it; may be empty
    std::string name;    ///< as the device states it; may be empty
    std::string path;    ///< bus and ports, such as "1-4.2": the socket of the device
    std::uint8_t bus = 0;
    std::uint8_t address = 0;  ///< address on the bus; changes with each plug-in
    bool permitted = false;    ///< true if this user could open it when the list was made

    [[nodiscard]] UsbIdentity identity() const { return {vendor, product, serial}; }
    [[nodiscard]] bool is(const UsbIdentity& wanted) const noexcept;
    /// Returns the file that a program opens, such as "/dev/bus/usb/001/002"; changes with each plug-in.
    [[nodiscard]] std::string node() const;
    /// Returns "USB device 0483:5740 at 1-4.2 (serial 17)", for messages.
    [[nodiscard]] std::string label() const;
    /// Says in a sentence why this user cannot open the device and what helps; empty for a permitted device.
    [[nodiscard]] std::string obstacle() const;
};

/// Describes a present device. The texts come from sysfs, where the kernel stored them at plug-in, so that even a
/// device that may not be opened has its serial number; unprintable characters become "?".
[[nodiscard]] UsbDeviceInfo describe(libusb_device* device);

}  // namespace tacto
