// UsbDeviceInfo.h - what is known of a USB device without opening it.
//
// Thread-safety: values; describe() any thread.
#pragma once

#include <cstdint>
#include <string>

struct libusb_device;

namespace tacto {

/// Identifies a device after a re-plug in any socket.
struct UsbIdentity {
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    std::string serial = {};  ///< empty: any
    friend bool operator==(const UsbIdentity&, const UsbIdentity&) = default;
};

struct UsbDeviceInfo {
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    std::string serial;  ///< empty where the device has none
    std::string maker;   ///< as the device says; empty where it does not
    std::string name;    ///< as the device says; empty where it does not
    std::string path;    ///< bus and ports, as "1-4.2": the socket it is in
    std::uint8_t bus = 0;
    std::uint8_t address = 0;  ///< the address on its bus; another one after each plug-in
    bool permitted = false;    ///< this user could open it when the list was made

    [[nodiscard]] UsbIdentity identity() const { return {vendor, product, serial}; }
    [[nodiscard]] bool is(const UsbIdentity& wanted) const noexcept;
    /// "/dev/bus/usb/001/002": what a program opens; another one after each plug-in.
    [[nodiscard]] std::string node() const;
    /// "USB device 0483:5740 at 1-4.2 (serial 17)", for messages.
    [[nodiscard]] std::string label() const;
    /// Why it cannot be opened and what helps, in a sentence; empty for a permitted device.
    [[nodiscard]] std::string obstacle() const;
};

/// Describes a present device. The texts are those that the kernel read when the device was plugged in (sysfs), so
/// that a device that may not be opened has its serial number too; what is not printable in them becomes "?".
[[nodiscard]] UsbDeviceInfo describe(libusb_device* device);

}  // namespace tacto
