#include <fmt/format.h>
#include <utility>

#include "tests/support/usb_emulation/HidEmulation.h"
#include "tests/support/usb_emulation/Published.h"

namespace tacto::test {

namespace {

/// True if the descriptor has a Report ID item (HID 1.11, section 6.2.2).
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
      usb(bed, hidDevice(vendor, product, serial, descriptor.size()), {}, port, false) {}

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
