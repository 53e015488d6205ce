// HidEmulation.h - the inside of an EmulatedHidDevice: HidrawCalls.cpp answers system calls on /dev/hidrawN,
// HidReports.cpp emulates the device behind them, EmulatedHidDevice.cpp offers the functions for tests.
//
// Thread-safety: every public function locks `mutex`, which guards everything unless stated otherwise.
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <umockdev.h>

#include "tests/support/usb_emulation/EmulatedHidDevice.h"
#include "tests/support/usb_emulation/HidrawNode.h"
#include "tests/support/usb_emulation/Published.h"

namespace tacto::test {

struct EmulatedHidDevice::Emulation {
    Emulation(UsbTestbed& bed, std::uint16_t vendorId, std::uint16_t productId, std::string serialNumber,
              UsbBytes reportDescriptor, HidBehaviour behaves, int port);
    ~Emulation() { takeOver(); }
    Emulation(const Emulation&) = delete;
    Emulation& operator=(const Emulation&) = delete;
    static void connectTo(const std::shared_ptr<Emulation>& self);

    static gboolean onIoctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user);
    static gboolean onRead(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user);
    static gboolean onWrite(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user);
    static void onConnected(UMockdevIoctlBase*, UMockdevIoctlClient*, gpointer user);
    static void onVanished(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer user);

    [[nodiscard]] std::string hidFolder() const {
        return fmt::format("{}/{}:1.0/0003:{:04X}:{:04X}.0001", usb.sysfs(), usb.socket(), vendor, product);
    }
    long ioctl(UMockdevIoctlClient* client, int& error);
    void write(UMockdevIoctlClient* client);
    std::vector<UsbBytes> take(std::span<const std::uint8_t> report);
    void setFeature(std::span<const std::uint8_t> report, std::uint8_t number);
    std::optional<UsbBytes> getFeature(std::uint8_t number);
    void releaseHeld();

    UsbTestbed& testbed;
    const std::uint16_t vendor;
    const std::uint16_t product;
    const std::string serial;
    const UsbBytes descriptor;
    const bool numbered;
    const HidBehaviour behaviour;
    const std::string node;
    const int minor;
    UMockdevIoctlBase* const handler;  // the device's handler, which keeps this object alive

    mutable std::mutex mutex;  // guards everything below except usb
    mutable std::condition_variable changed;
    std::unique_ptr<HidrawNode> fifo;  // null: unplugged
    int readers = 0;
    std::vector<UsbBytes> reports;
    std::vector<UsbBytes> set;
    std::map<std::uint8_t, UsbBytes> features;
    std::optional<std::size_t> takeOnly;
    int writeError = 0;
    bool held = false;
    std::vector<UMockdevIoctlClient*> waiting;  // holds a reference to each

    EmulatedUsbDevice usb;
};

}  // namespace tacto::test
