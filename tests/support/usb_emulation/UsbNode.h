// UsbNode.h - the device node of an emulated USB device. umockdev would make it a regular file, for which poll() is
// always ready, so that libusb spins. It is the slave of a pseudo-terminal instead, whose flow control gives poll()
// the meaning it has for usbfs: stopped is "nothing to reap", running is "an URB can be reaped" (POLLOUT), and
// closing the master is "disconnected" (POLLERR and POLLHUP).
//
// Thread-safety: none; UsbEmulation locks.
#pragma once

#include <filesystem>

namespace tacto::test {

class UsbNode {
public:
    /// Makes the node at `path` with permission bits `mode`.
    UsbNode(const std::filesystem::path& path, unsigned mode);
    ~UsbNode();  ///< disconnects the program that has it open
    UsbNode(const UsbNode&) = delete;
    UsbNode& operator=(const UsbNode&) = delete;

    void setReapable(bool reapable) noexcept;
    void setMode(unsigned mode) noexcept;

private:
    std::filesystem::path path_;
    int master_ = -1;
    int slave_ = -1;
};

}  // namespace tacto::test
