// EmulatedUsbDevice.h - a USB device without hardware, seen by the real libusb of this process and its children.
// Bytes in, bytes out: what the host writes goes to `onBytes`, whose answer goes back to the host; what a device says
// by itself is send(). Faults happen on the test's command.
//
// It behaves as the kernel and the bus do: packets end transfers, an interface must be claimed before its endpoints are
// used, a kernel driver must have let go before, a stall stays until it is cleared, and an unplugged device that comes
// back is a new one with another address.
//
// Thread-safety: all members any thread. `onBytes` and `onRequest` are called by whichever thread moves the bytes
// (umockdev's, mostly), each one call at a time, with nothing locked; they must not wait for the host, and what
// they share with the test is atomic or locked.
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

/// A SETUP packet as the device gets it.
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
    /// One OUT transfer; what is returned goes to the IN endpoint of the same number (nothing: no answer).
    std::function<UsbBytes(std::span<const std::uint8_t>)> onBytes = {};
    /// A class or vendor request, with its data for an output; nothing: the device stalls it. Left out: outputs are
    /// taken, inputs stalled.
    std::function<std::optional<UsbBytes>(const UsbSetup&, std::span<const std::uint8_t>)> onRequest = {};
};

class EmulatedUsbDevice {
public:
    /// Plugged in at once into port `port` of bus 1, unless `plugged` is false.
    EmulatedUsbDevice(UsbTestbed& testbed, UsbDescription description, UsbBehaviour behaviour, int port = 1,
                      bool plugged = true);
    ~EmulatedUsbDevice();
    EmulatedUsbDevice(const EmulatedUsbDevice&) = delete;
    EmulatedUsbDevice& operator=(const EmulatedUsbDevice&) = delete;

    void unplug();
    void plug();
    /// The socket it is plugged into: "1-1".
    [[nodiscard]] std::string socket() const;
    /// Its folder in /sys, for devices below it.
    [[nodiscard]] std::string sysfs() const;

    /// The device says something by itself. `end`: with an empty packet after a full last one, as a good device does.
    void send(std::uint8_t endpoint, std::span<const std::uint8_t> bytes, bool end = false);
    /// One packet, however large it is: for a device that lies about its lengths.
    void sendPacket(std::uint8_t endpoint, std::span<const std::uint8_t> packet);

    /// Stalls the endpoint until the host clears it.
    void stall(std::uint8_t endpoint);
    /// The endpoint takes and gives nothing while held; control requests are held with endpoint 0.
    void hold(std::uint8_t endpoint, bool held);
    /// The next OUT transfer is taken in part.
    void takeOnly(std::uint8_t endpoint, std::size_t bytes);
    /// Lets users other than root open it, or not.
    void permit(bool permitted);
    /// Claims an interface as another program would.
    void claimElsewhere(std::uint8_t interface);
    /// The kernel's driver lets go without coming back: what a program that was killed leaves behind.
    void loseKernelDriver();
    /// The kernel's driver offers it as this terminal, "ttyACM0", of `interface`, until it is unplugged. Returns the
    /// file that is behind /dev/ttyACM0.
    [[nodiscard]] std::filesystem::path addTerminal(const std::string& name, int interface = 0);
    /// The file that is behind its node in /dev/bus/usb.
    [[nodiscard]] std::filesystem::path nodeFile() const;

    /// Waits until so many of the host's transfers wait at the endpoint; false after 5 s.
    [[nodiscard]] bool waitForWaiting(std::uint8_t endpoint, std::size_t transfers) const;
    /// Waits until the device got so many OUT transfers in all, and returns all of them; fewer after 5 s.
    [[nodiscard]] std::vector<UsbBytes> waitForReceived(std::size_t transfers) const;
    /// Class and vendor requests that the device got, in order.
    [[nodiscard]] std::vector<UsbSetup> requests() const;
    /// Waits until there are so many requests, and returns them; fewer after 5 s.
    [[nodiscard]] std::vector<UsbSetup> waitForRequests(std::size_t count) const;
    /// Whether the kernel's driver holds its interfaces now.
    [[nodiscard]] bool kernelDriverBound() const;
    /// Times that a host cleared a stall.
    [[nodiscard]] int cleared() const;

private:
    struct Emulation;
    std::shared_ptr<Emulation> emulation_;  // umockdev owns it, too, as long as a client has the node open
};

}  // namespace tacto::test
