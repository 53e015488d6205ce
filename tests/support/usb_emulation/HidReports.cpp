#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "tests/support/usb_emulation/HidEmulation.h"
#include "tests/support/usb_emulation/Published.h"

namespace tacto::test {

namespace {

constexpr std::uint8_t kInterruptIn = 0x81;
// HID 1.11, sections 7.1 and 7.2.
constexpr std::uint8_t kGetReport = 1;
constexpr std::uint8_t kSetReport = 9;
constexpr std::uint8_t kSetIdle = 10;
constexpr unsigned kFeature = 3;

/// Whether the descriptor has a Report ID item (HID 1.11, section 6.2.2).
bool numbersReports(std::span<const std::uint8_t> descriptor) {
    constexpr std::uint8_t kReportId = 0x84;
    for (std::size_t at = 0; at < descriptor.size();) {
        if ((descriptor[at] & 0xFC) == kReportId) return true;
        const std::size_t size = descriptor[at] & 3U;
        at += 1 + (size == 3 ? 4 : size);
    }
    return false;
}

}  // namespace

EmulatedHidDevice::Emulation::Emulation(UsbTestbed& bed, std::uint16_t vendorId, std::uint16_t productId,
                                        std::string serialNumber, UsbBytes reportDescriptor, HidBehaviour behaves,
                                        int port)
    : testbed(bed),
      vendor(vendorId),
      product(productId),
      serial(std::move(serialNumber)),
      descriptor(std::move(reportDescriptor)),
      numbered(numbersReports(descriptor)),
      behaviour(std::move(behaves)),
      node(fmt::format("/dev/hidraw{}", port - 1)),
      minor(port - 1),
      handler(umockdev_ioctl_base_new()),
      usb(bed, hidDevice(vendor, product, serial, descriptor.size()),
          {[this](auto bytes) { return fromUsb(bytes); },
           [this](const auto& setup, auto data) { return request(setup, data); }},
          port, false) {}

void EmulatedHidDevice::Emulation::connectTo(const std::shared_ptr<Emulation>& self) {
    const auto on = [&self](const char* signal, auto callback) {
        connect(self->handler, signal, reinterpret_cast<GCallback>(callback), self);
    };
    on("handle-ioctl", &Emulation::onIoctl);
    on("handle-read", &Emulation::onRead);
    on("handle-write", &Emulation::onWrite);
    on("client-connected", &Emulation::onConnected);
    on("client-vanished", &Emulation::onVanished);
}

std::vector<UsbBytes> EmulatedHidDevice::Emulation::take(std::span<const std::uint8_t> report) {
    {
        const std::lock_guard lock(mutex);
        reports.emplace_back(report.begin(), report.end());
        changed.notify_all();
    }
    return behaviour.onReport ? behaviour.onReport(report) : std::vector<UsbBytes>{};
}

UsbBytes EmulatedHidDevice::Emulation::fromUsb(std::span<const std::uint8_t> report) {
    for (const auto& answer : take(report)) usb.send(kInterruptIn, answer);
    return {};
}

std::optional<UsbBytes> EmulatedHidDevice::Emulation::request(const UsbSetup& setup,
                                                              std::span<const std::uint8_t> data) {
    constexpr std::uint8_t kToInterface = 0x21;
    constexpr std::uint8_t kFromInterface = 0xA1;
    const auto number = static_cast<std::uint8_t>(setup.value & 0xFF);
    const unsigned kind = setup.value >> 8;
    if (setup.type == kToInterface && setup.request == kSetIdle) return UsbBytes{};
    if (setup.type == kToInterface && setup.request == kSetReport) {
        if (kind == kFeature)
            setFeature(data, number);
        else
            for (const auto& answer : take(data)) usb.send(kInterruptIn, answer);
        return UsbBytes{};
    }
    if (setup.type == kFromInterface && setup.request == kGetReport && kind == kFeature) return getFeature(number);
    constexpr unsigned kReportDescriptor = 0x22;
    if (setup.type == 0x81 && setup.request == 6 && kind == kReportDescriptor) {
        return UsbBytes(descriptor.begin(),
                        descriptor.begin() + std::min<std::ptrdiff_t>(std::ssize(descriptor), setup.length));
    }
    return std::nullopt;
}

void EmulatedHidDevice::Emulation::setFeature(std::span<const std::uint8_t> report, std::uint8_t number) {
    const std::lock_guard lock(mutex);
    features[number].assign(report.begin(), report.end());
    set.emplace_back(report.begin(), report.end());
    changed.notify_all();
}

std::optional<UsbBytes> EmulatedHidDevice::Emulation::getFeature(std::uint8_t number) {
    if (behaviour.onFeature) {
        if (auto report = behaviour.onFeature(number)) return report;
    }
    const std::lock_guard lock(mutex);
    const auto known = features.find(number);
    if (known == features.end()) return std::nullopt;
    return known->second;
}

}  // namespace tacto::test
