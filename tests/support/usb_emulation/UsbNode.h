// UsbNode.h - the device node of an emulated USB device. umockdev would make it a regular file, on which poll() is
// always ready, so that libusb would spin. Here it is the slave of a pseudo-terminal, where flow control gives poll()
// the meaning it has for usbfs: stopped means "nothing to reap", running means "an URB can be reaped" (POLLOUT), and a
// closed master means "disconnected" (POLLERR and POLLHUP).
//
// Thread-safety: none; UsbEmulation locks.
#pragma once

#include <filesystem>

namespace tacto::test {

class UsbNode {
public:
    /// Makes the node at `path` with permission bits `mode`.
    UsbNode(const std::filesystem::path& path, unsigned mode);
    ~UsbNode();  ///< disconnects a program that has the node open
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
