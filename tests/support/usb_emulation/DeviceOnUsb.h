// DeviceOnUsb.h - an emulated device plugged into the emulated bus; its driver reaches it through the real libusb, on
// the steady clock.
//
// Thread-safety: any thread.
#pragma once

#include "tests/support/emulated/DeviceFeed.h"
#include "tests/support/usb_emulation/EmulatedUsbDevice.h"

namespace tacto::test {

template <class Device>
class DeviceOnUsb {
public:
    /// `powerUp` and `rest` are those of DeviceFeed. The bulk endpoints in `description` must have number 1.
    DeviceOnUsb(UsbTestbed& bed, const Clock& clock, UsbDescription description,
                typename DeviceFeed<Device>::PowerUp powerUp, int port = 1, Instant rest = Instant(0))
        : feed_(
              clock, [this](auto bytes) { usb_.send(0x81, bytes); }, std::move(powerUp), rest),
          usb_(bed, std::move(description),
               {.onBytes =
                    [this](auto bytes) {
                        feed_.receive(bytes);
                        return UsbBytes{};
                    }},
               port) {}
    ~DeviceOnUsb() { feed_.stop(); }
    DeviceOnUsb(const DeviceOnUsb&) = delete;
    DeviceOnUsb& operator=(const DeviceOnUsb&) = delete;

    /// Unplugs the device, which also cuts its power.
    void unplug() {
        usb_.unplug();
        feed_.power(false);
    }
    void plug() {
        feed_.power(true);
        usb_.plug();
    }
    [[nodiscard]] EmulatedUsbDevice& usb() noexcept { return usb_; }
    /// Calls `look(device, now)` while no other thread can use the device.
    template <class Look>
    auto inspect(Look&& look) {
        return feed_.inspect(std::forward<Look>(look));
    }

private:
    DeviceFeed<Device> feed_;
    EmulatedUsbDevice usb_;
};

}  // namespace tacto::test
