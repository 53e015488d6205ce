// UsbControl.h - sends one vendor request again and again with different values, for devices that understand nothing
// else, such as the Trance Vibrator (0B49:064F; bmRequestType 0x43, bRequest 1, wValue = speed 0 to 255).
//
// Thread-safety: one thread calls send() and destroys, never libusb's event thread; any thread may call sendUrgent() at
// any time, even during send().
#pragma once

#include <memory>

#include "drivers/usb/UsbContext.h"
#include "drivers/usb/UsbDevice.h"

namespace tacto {

class UsbControl {
public:
    /// Opens the device and claims its interface 0, so that no kernel driver or other program controls it meanwhile.
    /// `request` must be an output request without data; its value is ignored. Errors: as UsbDevice::open() and
    /// claim(); InvalidArgument for an input request.
    [[nodiscard]] static Result<std::unique_ptr<UsbControl>> open(std::shared_ptr<UsbContext> context,
                                                                  const UsbDeviceInfo& info, const UsbRequest& request);
    /// Lets an urgent request leave (0.1 s at most), then closes the device.
    ~UsbControl();

    /// Sends the request with `value`; returns when the device has taken it. Errors: Timeout (the request was
    /// cancelled); Device (gone, or it refused).
    [[nodiscard]] Result<void> send(std::uint16_t value, Seconds timeout);

    /// Queues the request after a running one and before any later one. Returns without waiting; never throws, never
    /// allocates. Used for the stop.
    void sendUrgent(std::uint16_t value) noexcept;

    /// Returns how many urgent requests the device took. Any thread.
    [[nodiscard]] std::uint64_t urgentDelivered() const noexcept;
    [[nodiscard]] const UsbDeviceInfo& info() const noexcept;

private:
    struct Parts;
    explicit UsbControl(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace tacto
