// EmulatedUsbDevice.h - a USB device without hardware, which the real libusb of this process and its children sees.
// Bytes from the host go to `onBytes`, which returns the answer; send() sends bytes on the device's own initiative.
// Faults happen when the test asks for them.
//
// Behaves like the kernel and the bus: packets end transfers; an interface must be claimed, and released by the
// kernel's driver, before its endpoints are used; a stall lasts until it is cleared; a device that is plugged in again
// is a new device with another address.
//
// Thread-safety: any thread. `onBytes` and `onRequest` are called by whichever thread moves the bytes (mostly
// umockdev's), each one call at a time and without a lock. They must not wait for the host, and data that they share
// with the test must be atomic or locked.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/support/usb_emulation/UsbDescription.h"
#include "tests/support/usb_emulation/UsbTestbed.h"

namespace tacto::test {

/// A SETUP packet as the device receives it.
struct UsbSetup {
    std::uint8_t type = 0;
    std::uint8_t request = 0;
    std::uint16_t value = 0;
    std::uint16_t index = 0;
    std::uint16_t length = 0;
    friend bool operator==(const UsbSetup&, const UsbSetup&) = default;
};

using UsbBytes = std::vector<std::uint8_t>;

struct UsbBehaviour {
    /// Handles one OUT transfer; the result goes to the IN endpoint of the same number (empty: no answer).
    std::function<UsbBytes(std::span<const std::uint8_t>)> onBytes = {};
    /// Handles a class or vendor request, with its data if it is an output; an empty result stalls it. Without this
    /// function, outputs are accepted and inputs stalled.
    std::function<std::optional<UsbBytes>(const UsbSetup&, std::span<const std::uint8_t>)> onRequest = {};
};

class EmulatedUsbDevice {
public:
    /// Plugs the device into port `port` of bus 1 at once, unless `plugged` is false.
    EmulatedUsbDevice(UsbTestbed& testbed, UsbDescription description, UsbBehaviour behaviour, int port = 1,
                      bool plugged = true);
    ~EmulatedUsbDevice();
    EmulatedUsbDevice(const EmulatedUsbDevice&) = delete;
    EmulatedUsbDevice& operator=(const EmulatedUsbDevice&) = delete;

    void unplug();
    void plug();
    /// Returns the socket that the device is plugged into: "1-1".
    [[nodiscard]] std::string socket() const;
    /// Returns the device's folder in /sys, for devices below it.
    [[nodiscard]] std::string sysfs() const;

    /// Sends bytes on the device's own initiative. `end`: with an empty packet after a full last one, as is correct.
    void send(std::uint8_t endpoint, std::span<const std::uint8_t> bytes, bool end = false);
    /// Sends one packet of any size, for a device that states wrong lengths.
    void sendPacket(std::uint8_t endpoint, std::span<const std::uint8_t> packet);

    /// Stalls the endpoint until the host clears it.
    void stall(std::uint8_t endpoint);
    /// While held, the endpoint takes and gives nothing; endpoint 0 holds control requests.
    void hold(std::uint8_t endpoint, bool held);
    /// Makes the device take only a part of the next OUT transfer.
    void takeOnly(std::uint8_t endpoint, std::size_t bytes);
    /// Allows or forbids users other than root to open the device.
    void permit(bool permitted);
    /// Claims an interface as another program would.
    void claimElsewhere(std::uint8_t interface);
    /// Makes the kernel's driver let go and not return, as after a program was killed.
    void loseKernelDriver();
    /// Makes the kernel's driver offer `interface` as a terminal of this name ("ttyACM0") until unplugged. Returns the
    /// real file behind /dev/ttyACM0.
    [[nodiscard]] std::filesystem::path addTerminal(const std::string& name, int interface = 0);
    /// Returns the real file behind the device's node in /dev/bus/usb.
    [[nodiscard]] std::filesystem::path nodeFile() const;

    /// Waits until this many transfers of the host wait at the endpoint; returns false after 5 s.
    [[nodiscard]] bool waitForWaiting(std::uint8_t endpoint, std::size_t transfers) const;
    /// Waits until the device got this many OUT transfers in total, and returns all; returns fewer after 5 s.
    [[nodiscard]] std::vector<UsbBytes> waitForReceived(std::size_t transfers) const;
    /// Returns the class and vendor requests that the device got, in order.
    [[nodiscard]] std::vector<UsbSetup> requests() const;
    /// Waits until there are `count` requests, and returns them; returns fewer after 5 s.
    [[nodiscard]] std::vector<UsbSetup> waitForRequests(std::size_t count) const;
    /// True while the kernel's driver holds the device's interfaces.
    [[nodiscard]] bool kernelDriverBound() const;
    /// Returns how often a host cleared a stall.
    [[nodiscard]] int cleared() const;

private:
    struct Emulation;
    std::shared_ptr<Emulation> emulation_;  // umockdev also owns it while a client has the node open
};

}  // namespace tacto::test
