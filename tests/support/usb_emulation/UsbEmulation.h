// UsbEmulation.h - the inside of an EmulatedUsbDevice: the kernel's side of its node (usbfs) and the device behind it.
// UsbEmulation.cpp answers system calls, UsbControlPipe.cpp requests to endpoint 0, EmulatedUsbDevice.cpp the test.
//
// Thread-safety: functions with a `lock` argument need it held; `mutex` guards everything unless stated otherwise.
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <umockdev.h>

#include "tests/support/usb_emulation/EmulatedUsbDevice.h"
#include "tests/support/usb_emulation/Published.h"
#include "tests/support/usb_emulation/UsbNode.h"
#include "tests/support/usb_emulation/UsbWire.h"

namespace tacto::test {

// The layout of a control request (USB 2.0, 9.3).
constexpr std::size_t kSetupSize = 8;
constexpr std::uint8_t kInputBit = 0x80;

struct EmulatedUsbDevice::Emulation {
    Emulation(UsbTestbed& bed, UsbDescription described, UsbBehaviour behaves, int port);
    ~Emulation() { takeOver(); }
    Emulation(const Emulation&) = delete;
    Emulation& operator=(const Emulation&) = delete;
    static void connectTo(const std::shared_ptr<Emulation>& self);

    static gboolean onIoctl(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer user);
    static void onConnected(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer user);
    static void onVanished(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer user);

    /// The result of an ioctl.
    struct Answer {
        long result = 0;
        int error = 0;
    };
    static Answer refuse(int error) { return {-1, error}; }
    Answer ioctl(std::unique_lock<std::mutex>& lock, UMockdevIoctlClient* client);
    Answer submit(std::unique_lock<std::mutex>& lock, UMockdevIoctlData* argument, const void* client);
    Answer claim(unsigned interface, const void* client);
    Answer driverIoctl(UMockdevIoctlData* argument);
    Answer controlNow(std::unique_lock<std::mutex>& lock, UMockdevIoctlData* argument, const void* client);
    Answer bulkNow(std::unique_lock<std::mutex>& lock, UMockdevIoctlData* argument, const void* client);
    Answer clearHalt(unsigned endpoint);
    void control(std::unique_lock<std::mutex>& lock, Urb urb);
    /// Returns the device's answer to a request; nothing if it stalls. `data` came with the request.
    std::optional<UsbBytes> answerTo(std::unique_lock<std::mutex>& lock, const UsbSetup& setup,
                                     std::span<const std::uint8_t> data);
    std::optional<UsbBytes> standard(const UsbSetup& setup) const;
    /// Moves all transfers that can proceed; releases the lock while it calls the device.
    void pump(std::unique_lock<std::mutex>& lock);
    void showReapable() {
        if (node) node->setReapable(wire.canReap());
        changed.notify_all();
    }

    UsbTestbed& testbed;
    const UsbDescription description;
    const UsbBehaviour behaviour;
    const std::string socket;
    const std::string sysfs;
    std::string terminal;  // the terminal's folder in /sys, or empty. Only the test's thread uses it

    mutable std::mutex mutex;  // guards everything below
    mutable std::condition_variable changed;
    UsbWire wire;
    UMockdevIoctlBase* const handler;  // the device's handler, which keeps this object alive
    std::unique_ptr<UsbNode> node;     // null: unplugged
    std::string path;                  // path of the node, such as "/dev/bus/usb/001/002"
    unsigned mode = 0666;
    bool kernelBound = false;
    std::set<const void*> connected;  // open files of this plug-in; files of earlier ones stay dead
    std::map<unsigned, const void*> claims;
    std::set<unsigned> elsewhere;
    bool controlHeld = false;
    bool pumping = false;
    std::vector<Urb> heldControls;
    std::vector<UsbBytes> received;
    std::vector<UsbSetup> requests;
    int cleared = 0;
};

}  // namespace tacto::test
