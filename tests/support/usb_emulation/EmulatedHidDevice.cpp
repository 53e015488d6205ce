#include "tests/support/usb_emulation/EmulatedHidDevice.h"

#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "tests/support/usb_emulation/HidEmulation.h"
#include "tests/support/usb_emulation/Published.h"

namespace tacto::test {

namespace {

constexpr auto kHidTimeout = std::chrono::seconds(5);

void check(GError* error) {
    if (error == nullptr) return;
    const std::string text = error->message;
    g_error_free(error);
    throw std::runtime_error("plugging in an emulated HID device: " + text);
}

}  // namespace

EmulatedHidDevice::EmulatedHidDevice(UsbTestbed& testbed, std::uint16_t vendor, std::uint16_t product,
                                     std::string serial, UsbBytes reportDescriptor, HidBehaviour behaviour, int port)
    : emulation_(std::make_shared<Emulation>(testbed, vendor, product, std::move(serial), std::move(reportDescriptor),
                                             std::move(behaviour), port)) {
    Emulation::connectTo(emulation_);
    plug();
}

EmulatedHidDevice::~EmulatedHidDevice() {
    unplug();
    auto* handler = emulation_->handler;
    publish();
    emulation_.reset();
    g_object_unref(handler);
}

void EmulatedHidDevice::plug() {
    auto& e = *emulation_;
    {
        const std::lock_guard lock(e.mutex);
        if (e.fifo) return;
        e.fifo = std::make_unique<HidrawNode>(e.testbed.root() / e.node.substr(1));
        e.readers = 0;
    }
    auto* bed = e.testbed.get();
    GError* error = nullptr;
    publish();
    umockdev_testbed_attach_ioctl(bed, e.node.c_str(), e.handler, &error);
    check(error);
    e.usb.plug();
    const auto add = [&](const std::string& text) {
        umockdev_testbed_add_from_string(bed, text.c_str(), &error);
        check(error);
    };
    const auto hid = e.hidFolder();
    add(
        fmt::format("P: {}/{}:1.0\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_interface\nE: DRIVER=usbhid\nE: INTERFACE=3/0/0\n"
                    "A: bInterfaceNumber=00\\n\n",
                    e.usb.sysfs().substr(4), e.usb.socket()));
    add(
        fmt::format("P: {}\nE: SUBSYSTEM=hid\nE: DRIVER=hid-generic\nE: HID_ID=0003:{:08X}:{:08X}\n"
                    "E: HID_NAME=Acme Loopback HID\nE: HID_UNIQ={}\nE: HID_PHYS=usb-0/input0\n",
                    hid.substr(4), e.vendor, e.product, e.serial));
    auto descriptor = e.descriptor;
    umockdev_testbed_set_attribute_binary(bed, hid.c_str(), "report_descriptor", descriptor.data(),
                                          static_cast<int>(descriptor.size()));
    add(
        fmt::format("P: {}/hidraw/{}\nE: SUBSYSTEM=hidraw\nE: DEVNAME={}\nE: MAJOR=240\nE: MINOR={}\n"
                    "L: device=../../../0003:{:04X}:{:04X}.0001\n",
                    hid.substr(4), e.node.substr(5), e.node, e.minor, e.vendor, e.product));
}

void EmulatedHidDevice::unplug() {
    auto& e = *emulation_;
    std::unique_ptr<HidrawNode> fifo;
    {
        const std::lock_guard lock(e.mutex);
        if (!e.fifo) return;
        fifo = std::move(e.fifo);
        constexpr std::uint8_t kWake[] = {0};  // lets a program that waits in poll() call read(), which fails with EIO
        (void)fifo->put(kWake);
        e.changed.notify_all();
    }
    e.releaseHeld();
    fifo.reset();
    auto* bed = e.testbed.get();
    umockdev_testbed_detach_ioctl(bed, e.node.c_str(), nullptr);
    const auto hid = e.hidFolder();
    const auto raw = hid + "/hidraw/" + e.node.substr(5);
    umockdev_testbed_uevent(bed, raw.c_str(), "remove");
    for (const auto& folder : {raw, hid, e.usb.sysfs() + "/" + e.usb.socket() + ":1.0"}) {
        umockdev_testbed_remove_device(bed, folder.c_str());
    }
    e.usb.unplug();
}

void EmulatedHidDevice::send(std::span<const std::uint8_t> report) {
    auto& e = *emulation_;
    const std::lock_guard lock(e.mutex);
    if (e.fifo && e.readers > 0) (void)e.fifo->put(report);
}

void EmulatedHidDevice::takeOnly(std::size_t bytes) {
    const std::lock_guard lock(emulation_->mutex);
    emulation_->takeOnly = bytes;
}

void EmulatedHidDevice::refuseWrites(int error) {
    const std::lock_guard lock(emulation_->mutex);
    emulation_->writeError = error;
}

void EmulatedHidDevice::hold(bool held) {
    {
        const std::lock_guard lock(emulation_->mutex);
        emulation_->held = held;
    }
    if (!held) emulation_->releaseHeld();
}

std::vector<UsbBytes> EmulatedHidDevice::waitForReports(std::size_t count) const {
    std::unique_lock lock(emulation_->mutex);
    emulation_->changed.wait_for(lock, kHidTimeout, [&] { return emulation_->reports.size() >= count; });
    return emulation_->reports;
}

std::vector<UsbBytes> EmulatedHidDevice::featuresSet() const {
    const std::lock_guard lock(emulation_->mutex);
    return emulation_->set;
}

EmulatedUsbDevice& EmulatedHidDevice::usb() noexcept { return emulation_->usb; }

}  // namespace tacto::test
