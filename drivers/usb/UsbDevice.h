// UsbDevice.h - an open USB device: claims its interfaces, detaches and restores the kernel's drivers, and sends
// requests to its control endpoint.
//
// Destruction releases the interfaces, returns the device to the kernel's drivers (even if a killed program left it
// without a driver) and closes it; all transfers must have ended before.
// Thread-safety: one thread at a time, and never the event thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/Units.h"
#include "drivers/system/FileHolders.h"
#include "drivers/usb/UsbContext.h"
#include "drivers/usb/UsbEndpoints.h"

namespace tacto {

/// The first 6 bytes of a SETUP packet, USB 2.0 section 9.3.
struct UsbRequest {
    std::uint8_t type = 0;     ///< bmRequestType; bit 7 is set for input
    std::uint8_t request = 0;  ///< bRequest
    std::uint16_t value = 0;   ///< wValue
    std::uint16_t index = 0;   ///< wIndex
};

class UsbDevice {
public:
    /// Errors: NotFound (unplugged meanwhile); Io with a sentence that says what helps (not permitted).
    [[nodiscard]] static Result<std::shared_ptr<UsbDevice>> open(std::shared_ptr<UsbContext> context,
                                                                 const UsbDeviceInfo& info);
    ~UsbDevice();
    UsbDevice(const UsbDevice&) = delete;
    UsbDevice& operator=(const UsbDevice&) = delete;

    [[nodiscard]] const UsbDeviceInfo& info() const noexcept { return info_; }
    [[nodiscard]] const std::string& label() const noexcept { return label_; }
    /// Errors: Device if the device's descriptors cannot be read; as findBulkPair().
    [[nodiscard]] Result<UsbBulkPair> bulkPair(UsbFunction function) const;

    /// Takes an interface for this program alone, from the kernel's driver too, but never from another program that has
    /// claimed it or has a node of the kernel's driver open (/dev/ttyACM0, /dev/hidraw0). Errors: Io naming the program
    /// that holds it; Device (gone, or it has no such interface).
    [[nodiscard]] Result<void> claim(std::uint8_t interface);

    /// Sends a request with `data` and waits for its end. Errors: Timeout; Device (gone, refused, took fewer bytes).
    [[nodiscard]] Result<void> controlOut(const UsbRequest& request, std::span<const std::uint8_t> data,
                                          Seconds timeout);
    /// Clears a stalled endpoint. Errors: Device (gone, refused).
    [[nodiscard]] Result<void> clearHalt(std::uint8_t endpoint);

    [[nodiscard]] libusb_device_handle* handle() const noexcept { return handle_; }

private:
    UsbDevice(std::shared_ptr<UsbContext> context, UsbDeviceInfo info, libusb_device_handle* handle)
        : context_(std::move(context)), info_(std::move(info)), label_(info_.label()), handle_(handle) {}
    [[nodiscard]] tl::unexpected<Error> inUse(const std::string& what, const std::filesystem::path& node,
                                              const std::vector<FileHolder>& holders) const;

    const std::shared_ptr<UsbContext> context_;  // outlives the handle
    const UsbDeviceInfo info_;
    const std::string label_;
    libusb_device_handle* const handle_;
    std::vector<std::uint8_t> claimed_;
};

}  // namespace tacto
