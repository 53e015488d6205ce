// UsbTestbed.h - a USB bus without hardware, for the process that creates it and its children: umockdev answers their
// system calls on /sys, /dev and udev. A test must create it before libusb or hidapi starts.
//
// Works only in a program started through with-emulated-usb; otherwise the constructor throws and says so.
// Thread-safety: the test's own thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

struct _UMockdevTestbed;

namespace tacto::test {

class UsbTestbed {
public:
    UsbTestbed();
    ~UsbTestbed();
    UsbTestbed(const UsbTestbed&) = delete;
    UsbTestbed& operator=(const UsbTestbed&) = delete;

    [[nodiscard]] _UMockdevTestbed* get() const noexcept { return testbed_; }
    /// Returns the real folder that holds the emulated /sys and /dev.
    [[nodiscard]] std::filesystem::path root() const;
    /// Returns the next device address on the bus; as on a real bus, each plug-in gets another one.
    [[nodiscard]] std::uint8_t nextAddress() noexcept { return ++address_; }

private:
    _UMockdevTestbed* testbed_;
    std::uint8_t address_ = 1;  // 1 is the root hub
};

/// While this object lives, the process is a user without privileges, so that permissions apply even to root. Other
/// threads must not plug or unplug meanwhile.
class UnprivilegedUser {
public:
    explicit UnprivilegedUser(const UsbTestbed& testbed);
    ~UnprivilegedUser();
    UnprivilegedUser(const UnprivilegedUser&) = delete;
    UnprivilegedUser& operator=(const UnprivilegedUser&) = delete;

private:
    bool changed_ = false;
};

}  // namespace tacto::test
