#include "tests/support/usb_emulation/EmulatedUsbDevice.h"

#include <cerrno>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "tests/support/usb_emulation/Published.h"
#include "tests/support/usb_emulation/UsbEmulation.h"

namespace tacto::test {

namespace {

constexpr auto kTimeout = std::chrono::seconds(5);

void check(GError* error, const char* what) {
    if (error == nullptr) return;
    const std::string text = fmt::format("{}: {}", what, error->message);
    g_error_free(error);
    throw std::runtime_error(text);
}

}  // namespace

EmulatedUsbDevice::EmulatedUsbDevice(UsbTestbed& testbed, UsbDescription description, UsbBehaviour behaviour, int port,
                                     bool plugged)
    : emulation_(std::make_shared<Emulation>(testbed, std::move(description), std::move(behaviour), port)) {
    Emulation::connectTo(emulation_);
    if (plugged) plug();
}

EmulatedUsbDevice::~EmulatedUsbDevice() {
    unplug();
    auto* handler = emulation_->handler;
    publish();
    emulation_.reset();
    g_object_unref(handler);
}

void EmulatedUsbDevice::plug() {
    auto& e = *emulation_;
    const auto address = e.testbed.nextAddress();
    {
        const std::lock_guard lock(e.mutex);
        if (e.node) return;
        e.wire = UsbWire(endpointsOf(e.description));
        e.claims.clear();
        e.kernelBound = !e.description.kernelInterfaces.empty();
        e.path = fmt::format("/dev/bus/usb/001/{:03}", address);
        e.node = std::make_unique<UsbNode>(e.testbed.root() / e.path.substr(1), e.mode);
    }
    GError* error = nullptr;
    publish();
    umockdev_testbed_attach_ioctl(e.testbed.get(), e.path.c_str(), e.handler, &error);
    check(error, "attaching an emulated USB device");
    const auto& d = e.description;
    std::string descriptors;
    for (const auto byte : d.deviceDescriptor()) descriptors += fmt::format("{:02X}", byte);
    for (const auto byte : d.configuration) descriptors += fmt::format("{:02X}", byte);
    const auto text = fmt::format(
        "P: {}\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM={:03}\n"
        "E: DEVNAME={}\nE: MAJOR=189\nE: MINOR={}\nE: PRODUCT={:x}/{:x}/100\nA: busnum=1\\n\nA: devnum={}\\n\n"
        "A: speed={}\\n\nA: bConfigurationValue=1\\n\nA: idVendor={:04x}\\n\nA: idProduct={:04x}\\n\n"
        "A: manufacturer={}\\n\nA: product={}\\n\nA: serial={}\\n\nH: descriptors={}\n",
        e.sysfs.substr(4), address, e.path, address - 1, d.vendor, d.product, address, d.speed_mbit, d.vendor,
        d.product, d.maker, d.name, d.serial, descriptors);
    umockdev_testbed_add_from_string(e.testbed.get(), text.c_str(), &error);
    check(error, "plugging in an emulated USB device");
}

void EmulatedUsbDevice::unplug() {
    auto& e = *emulation_;
    std::unique_ptr<UsbNode> node;
    {
        const std::lock_guard lock(e.mutex);
        if (!e.node) return;
        node = std::move(e.node);
        for (auto& urb : e.heldControls) e.wire.finish(std::move(urb), -ESHUTDOWN, 0);
        e.heldControls.clear();
        e.wire.disconnect();
        e.connected.clear();
        e.claims.clear();
        e.kernelBound = false;
        e.changed.notify_all();
    }
    node.reset();
    umockdev_testbed_detach_ioctl(e.testbed.get(), e.path.c_str(), nullptr);
    if (!e.terminal.empty()) {
        for (const auto& folder : {e.terminal, fmt::format("{}/{}:1.0", e.sysfs, e.socket)}) {
            umockdev_testbed_remove_device(e.testbed.get(), folder.c_str());
        }
        e.terminal.clear();
    }
    umockdev_testbed_uevent(e.testbed.get(), e.sysfs.c_str(), "remove");
    umockdev_testbed_remove_device(e.testbed.get(), e.sysfs.c_str());
}

std::string EmulatedUsbDevice::socket() const { return emulation_->socket; }
std::string EmulatedUsbDevice::sysfs() const { return emulation_->sysfs; }

void EmulatedUsbDevice::send(std::uint8_t endpoint, std::span<const std::uint8_t> bytes, bool end) {
    std::unique_lock lock(emulation_->mutex);
    if (!emulation_->node) return;
    emulation_->wire.queue(endpoint, bytes, end);
    emulation_->pump(lock);
}

void EmulatedUsbDevice::sendPacket(std::uint8_t endpoint, std::span<const std::uint8_t> packet) {
    std::unique_lock lock(emulation_->mutex);
    if (!emulation_->node) return;
    emulation_->wire.queuePacket(endpoint, packet);
    emulation_->pump(lock);
}

void EmulatedUsbDevice::stall(std::uint8_t endpoint) {
    std::unique_lock lock(emulation_->mutex);
    emulation_->wire.setHalted(endpoint, true);
    emulation_->pump(lock);
}

void EmulatedUsbDevice::hold(std::uint8_t endpoint, bool held) {
    auto& e = *emulation_;
    std::unique_lock lock(e.mutex);
    if (endpoint != 0) {
        e.wire.setHeld(endpoint, held);
    } else {
        e.controlHeld = held;
        if (!held) {
            for (auto& urb : std::exchange(e.heldControls, {})) e.control(lock, std::move(urb));
        }
    }
    e.pump(lock);
}

void EmulatedUsbDevice::takeOnly(std::uint8_t endpoint, std::size_t bytes) {
    const std::lock_guard lock(emulation_->mutex);
    emulation_->wire.takeOnly(endpoint, bytes);
}

void EmulatedUsbDevice::permit(bool permitted) {
    const std::lock_guard lock(emulation_->mutex);
    emulation_->mode = permitted ? 0666 : 0;
    if (emulation_->node) emulation_->node->setMode(emulation_->mode);
}

void EmulatedUsbDevice::claimElsewhere(std::uint8_t interface) {
    const std::lock_guard lock(emulation_->mutex);
    emulation_->kernelBound = false;
    emulation_->elsewhere.insert(interface);
}

void EmulatedUsbDevice::loseKernelDriver() {
    const std::lock_guard lock(emulation_->mutex);
    emulation_->kernelBound = false;
}

std::filesystem::path EmulatedUsbDevice::addTerminal(const std::string& name, int interface) {
    auto& e = *emulation_;
    GError* error = nullptr;
    const auto text = fmt::format(
        "P: {0}/{1}:1.{3}\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_interface\nE: DRIVER=cdc_acm\nA: "
        "bInterfaceNumber=0{3}\\n\n\n"
        "P: {0}/{1}:1.{3}/tty/{2}\nN: {2}\nE: SUBSYSTEM=tty\nE: DEVNAME=/dev/{2}\nE: MAJOR=166\nE: MINOR=0\n",
        e.sysfs.substr(4), e.socket, name, interface);
    umockdev_testbed_add_from_string(e.testbed.get(), text.c_str(), &error);
    check(error, "adding an emulated terminal");
    e.terminal = fmt::format("{}/{}:1.{}/tty/{}", e.sysfs, e.socket, interface, name);
    return e.testbed.root() / "dev" / name;
}

std::filesystem::path EmulatedUsbDevice::nodeFile() const {
    const std::lock_guard lock(emulation_->mutex);
    return emulation_->testbed.root() / emulation_->path.substr(1);
}

bool EmulatedUsbDevice::waitForWaiting(std::uint8_t endpoint, std::size_t transfers) const {
    auto& e = *emulation_;
    std::unique_lock lock(e.mutex);
    return e.changed.wait_for(lock, kTimeout, [&] {
        return (endpoint == 0 ? e.heldControls.size() : e.wire.waitingAt(endpoint)) >= transfers;
    });
}

std::vector<UsbBytes> EmulatedUsbDevice::waitForReceived(std::size_t transfers) const {
    std::unique_lock lock(emulation_->mutex);
    emulation_->changed.wait_for(lock, kTimeout, [&] { return emulation_->received.size() >= transfers; });
    return emulation_->received;
}

std::vector<UsbSetup> EmulatedUsbDevice::requests() const {
    const std::lock_guard lock(emulation_->mutex);
    return emulation_->requests;
}

std::vector<UsbSetup> EmulatedUsbDevice::waitForRequests(std::size_t count) const {
    std::unique_lock lock(emulation_->mutex);
    emulation_->changed.wait_for(lock, kTimeout, [&] { return emulation_->requests.size() >= count; });
    return emulation_->requests;
}

bool EmulatedUsbDevice::kernelDriverBound() const {
    const std::lock_guard lock(emulation_->mutex);
    return emulation_->kernelBound;
}

int EmulatedUsbDevice::cleared() const {
    const std::lock_guard lock(emulation_->mutex);
    return emulation_->cleared;
}

}  // namespace tacto::test
