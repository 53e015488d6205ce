// EmulatedOnUsb.h - the emulated stimulator plugged into the emulated bus: the driver meets it through the real libusb,
// on the steady clock.
//
// Thread-safety: all members any thread.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "core/base/Clock.h"
#include "tests/support/emulated/sciencemode/EmulatedStimulator.h"
#include "tests/support/usb_emulation/EmulatedUsbDevice.h"

namespace tacto::test {

class EmulatedOnUsb {
public:
    EmulatedOnUsb(UsbTestbed& bed, const Clock& clock, sciencemode::EmulatedSettings settings = {});
    ~EmulatedOnUsb();
    EmulatedOnUsb(const EmulatedOnUsb&) = delete;
    EmulatedOnUsb& operator=(const EmulatedOnUsb&) = delete;

    /// Out of the socket and without power, as a battery-less device.
    void unplug();
    void plug() { usb_->plug(); }
    [[nodiscard]] EmulatedUsbDevice& usb() noexcept { return *usb_; }

    /// Does something with the device while no other thread does.
    template <class Act>
    auto inspect(Act act) {
        const std::scoped_lock lock(mutex_);
        return act(device_, clock_.now());
    }
    [[nodiscard]] std::size_t pulses() {
        return inspect([](auto& device, Instant now) { return device.pulses(now).size(); });
    }

private:
    void run();

    const Clock& clock_;
    std::mutex mutex_;
    std::condition_variable changed_;
    sciencemode::EmulatedStimulator device_;  // guarded by mutex_
    bool quitting_ = false;                   // guarded by mutex_
    std::unique_ptr<EmulatedUsbDevice> usb_;
    std::thread thread_;  // answers when answers are due
};

}  // namespace tacto::test
