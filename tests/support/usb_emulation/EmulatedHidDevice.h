// EmulatedHidDevice.h - a USB HID device without hardware, as /dev/hidrawN and as the USB device behind it. Reports
// have the bus format: the number comes first if the report descriptor numbers them.
//
// Input reports go to the programs that have the node open; if there is none, they are lost.
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
    /// Handles an output report; returns the input reports that answer it.
    std::function<std::vector<UsbBytes>(std::span<const std::uint8_t>)> onReport = {};
    /// Returns the feature report of this number. Empty function or result: what the host set last, or a refusal.
    std::function<std::optional<UsbBytes>(std::uint8_t)> onFeature = {};
};

class EmulatedHidDevice {
public:
    /// Plugs the device into port `port` at once; its node is /dev/hidraw<port - 1>.
    EmulatedHidDevice(UsbTestbed& testbed, std::uint16_t vendor, std::uint16_t product, std::string serial,
                      UsbBytes reportDescriptor, HidBehaviour behaviour, int port = 1);
    ~EmulatedHidDevice();
    EmulatedHidDevice(const EmulatedHidDevice&) = delete;
    EmulatedHidDevice& operator=(const EmulatedHidDevice&) = delete;

    void unplug();
    void plug();
    /// Sends an input report on the device's own initiative.
    void send(std::span<const std::uint8_t> report);

    /// Makes the next hidraw write take only this many bytes, as counted by write().
    void takeOnly(std::size_t bytes);
    /// Makes all hidraw writes fail with this errno until called with 0.
    void refuseWrites(int error);
    /// While held, hidraw writes wait, as on a slow device.
    void hold(bool held);

    /// Waits until the device got `count` output reports in total, and returns all; returns fewer after 5 s.
    [[nodiscard]] std::vector<UsbBytes> waitForReports(std::size_t count) const;
    /// Returns the feature reports that the host set, in order.
    [[nodiscard]] std::vector<UsbBytes> featuresSet() const;
    /// Returns the USB device behind the node, which answers no transfers.
    [[nodiscard]] EmulatedUsbDevice& usb() noexcept;

private:
    struct Emulation;
    std::shared_ptr<Emulation> emulation_;  // umockdev also owns it while a client has the node open
};

}  // namespace tacto::test
