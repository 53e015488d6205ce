#include "tests/drivers/sciencemode/EmulatedOnUsb.h"

#include <array>

namespace tacto::test {

namespace {
constexpr std::uint8_t kIn = 0x81;
}

EmulatedOnUsb::EmulatedOnUsb(UsbTestbed& bed, const Clock& clock, sciencemode::EmulatedSettings settings)
    : clock_(clock), device_(std::move(settings)) {
    UsbBehaviour behaviour;
    behaviour.onBytes = [this](std::span<const std::uint8_t> bytes) -> UsbBytes {
        const std::scoped_lock lock(mutex_);
        device_.receive(bytes, clock_.now());
        changed_.notify_all();
        return {};
    };
    usb_ = std::make_unique<EmulatedUsbDevice>(bed, cdcAcmDevice(0x0483, 0x5740, "P24-EMU-1"), std::move(behaviour));
    thread_ = std::thread([this] { run(); });
}

EmulatedOnUsb::~EmulatedOnUsb() {
    {
        const std::scoped_lock lock(mutex_);
        quitting_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void EmulatedOnUsb::unplug() {
    usb_->unplug();
    const std::scoped_lock lock(mutex_);
    device_.powerCycle(clock_.now());
}

void EmulatedOnUsb::run() {
    std::array<std::uint8_t, 1024> bytes{};
    std::unique_lock lock(mutex_);
    while (!quitting_) {
        if (const auto size = device_.transmit(bytes, clock_.now()); size > 0) {
            lock.unlock();
            usb_->send(kIn, std::span<const std::uint8_t>(bytes).first(size));
            lock.lock();
            continue;
        }
        const auto due = device_.nextTransmit();
        if (due)
            changed_.wait_for(lock, std::max(Instant(0), *due - clock_.now()));
        else
            changed_.wait(lock);
    }
}

}  // namespace tacto::test
