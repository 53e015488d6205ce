// UsbControl.h - one vendor request, sent over and over with another value: all that a device like the Trance
// Vibrator (0B49:064F; bmRequestType 0x43, bRequest 1, wValue = speed 0 to 255) understands.
//
// Thread-safety: send() and destruction one thread, never libusb's event thread; sendUrgent() any thread, at any
// moment, also while send() waits.
#pragma once

#include <memory>

#include "drivers/usb/UsbContext.h"
#include "drivers/usb/UsbDevice.h"

namespace tacto {

class UsbControl {
public:
    /// Opens the device and claims its interface 0, so that no kernel driver and no other program sets it meanwhile.
    /// `request` is one for output without data; its value is not used. Errors: as UsbDevice::open() and claim();
    /// InvalidArgument for a request that is for input.
    [[nodiscard]] static Result<std::unique_ptr<UsbControl>> open(std::shared_ptr<UsbContext> context,
                                                                  const UsbDeviceInfo& info, const UsbRequest& request);
    /// Lets an urgent request leave (0.1 s at most), then closes.
    ~UsbControl();

    /// Sends the request with `value`; returns when the device took it. Errors: Timeout (it was cancelled);
    /// Device (gone, or it refused).
    [[nodiscard]] Result<void> send(std::uint16_t value, Seconds timeout);

    /// Queues the request behind one that is under way and ahead of any later one. Returns without waiting; never
    /// throws, never allocates. For the stop.
    void sendUrgent(std::uint16_t value) noexcept;

    /// Urgent requests that the device took. Any thread.
    [[nodiscard]] std::uint64_t urgentDelivered() const noexcept;
    [[nodiscard]] const UsbDeviceInfo& info() const noexcept;

private:
    struct Parts;
    explicit UsbControl(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace tacto
