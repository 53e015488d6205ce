// EmulatedHidDevice.h - a USB HID device without hardware: as /dev/hidrawN, and as the USB device behind it. Reports
// are as on the wire: with their number in front where the report descriptor numbers them, without otherwise.
//
// Input reports go to the programs that have the node open; it keeps none while no program has.
//
// Thread-safety: as EmulatedUsbDevice.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tests/support/usb_emulation/EmulatedUsbDevice.h"

namespace tacto::test {

struct HidBehaviour {
    /// An output report; what is returned are input reports that answer it.
    std::function<std::vector<UsbBytes>(std::span<const std::uint8_t>)> onReport = {};
    /// The host asks for a feature report by number. Left out, or nothing: what the host set last, or a refusal.
    std::function<std::optional<UsbBytes>(std::uint8_t)> onFeature = {};
};

class EmulatedHidDevice {
public:
    /// Plugged in at once, into port `port`; its node is /dev/hidraw<port - 1>.
    EmulatedHidDevice(UsbTestbed& testbed, std::uint16_t vendor, std::uint16_t product, std::string serial,
                      UsbBytes reportDescriptor, HidBehaviour behaviour, int port = 1);
    ~EmulatedHidDevice();
    EmulatedHidDevice(const EmulatedHidDevice&) = delete;
    EmulatedHidDevice& operator=(const EmulatedHidDevice&) = delete;

    void unplug();
    void plug();
    /// An input report that the device sends by itself.
    void send(std::span<const std::uint8_t> report);

    /// The next hidraw write takes so many bytes only, as counted by write().
    void takeOnly(std::size_t bytes);
    /// All hidraw writes fail with this errno until it is 0.
    void refuseWrites(int error);
    /// hidraw writes wait while held: a slow device.
    void hold(bool held);

    /// Waits until the device got so many output reports in all, and returns all of them; fewer after 5 s.
    [[nodiscard]] std::vector<UsbBytes> waitForReports(std::size_t count) const;
    /// Feature reports that the host set, in order.
    [[nodiscard]] std::vector<UsbBytes> featuresSet() const;
    /// The USB device behind it, which answers no transfers.
    [[nodiscard]] EmulatedUsbDevice& usb() noexcept;

private:
    struct Emulation;
    std::shared_ptr<Emulation> emulation_;  // umockdev owns it, too, as long as a client has the node open
};

}  // namespace tacto::test
