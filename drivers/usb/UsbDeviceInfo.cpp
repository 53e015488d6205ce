#include "drivers/usb/UsbDeviceInfo.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fstream>
#include <libusb.h>
#include <unistd.h>

#include "drivers/system/Permission.h"

namespace tacto {

namespace {

constexpr std::size_t kMaxText = 126;  // characters of a USB string descriptor: (255 - 2) / 2

std::string socketOf(libusb_device* device) {
    std::array<std::uint8_t, 7> ports{};  // USB 3.1 section 8.9: at most 5 hubs deep; libusb wants room for 7
    const int depth = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
    std::string path = std::to_string(libusb_get_bus_number(device));
    for (int i = 0; i < depth; ++i) {
        path += (i == 0 ? "-" : ".") + std::to_string(ports[static_cast<std::size_t>(i)]);
    }
    return path;
}

/// Reads a line of sysfs; the text comes from the device and is untrusted.
std::string kernelText(const std::string& socket, const char* attribute) {
    std::ifstream file("/sys/bus/usb/devices/" + socket + "/" + attribute);
    std::string line;
    std::getline(file, line);
    line.resize(std::min(line.size(), kMaxText));
    std::ranges::replace_if(
        line, [](char c) { return c < ' ' || c > '~'; }, '?');
    return line;
}

}  // namespace

bool UsbDeviceInfo::is(const UsbIdentity& wanted) const noexcept {
    return vendor == wanted.vendor && product == wanted.product && (wanted.serial.empty() || serial == wanted.serial);
}

std::string UsbDeviceInfo::node() const { return fmt::format("/dev/bus/usb/{:03}/{:03}", bus, address); }

std::string UsbDeviceInfo::label() const {
    auto text = fmt::format("USB device {:04x}:{:04x} at {}", vendor, product, path);
    if (!serial.empty()) text += fmt::format(" (serial {})", serial);
    return text;
}

std::string UsbDeviceInfo::obstacle() const {
    if (permitted) return {};
    return fmt::format("{} is there, but this user may not open it: {}", label(), permissionAdvice());
}

UsbDeviceInfo describe(libusb_device* device) {
    UsbDeviceInfo info;
    libusb_device_descriptor descriptor{};
    if (libusb_get_device_descriptor(device, &descriptor) == 0) {
        info.vendor = descriptor.idVendor;
        info.product = descriptor.idProduct;
    }
    info.path = socketOf(device);
    info.bus = libusb_get_bus_number(device);
    info.address = libusb_get_device_address(device);
    info.serial = kernelText(info.path, "serial");
    info.maker = kernelText(info.path, "manufacturer");
    info.name = kernelText(info.path, "product");
    info.permitted = access(info.node().c_str(), R_OK | W_OK) == 0;
    return info;
}

}  // namespace tacto
