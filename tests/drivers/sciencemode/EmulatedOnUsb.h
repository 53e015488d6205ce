// EmulatedOnUsb.h - the emulated stimulator plugged into the emulated bus.
//
// Thread-safety: as DeviceOnUsb.
#pragma once

#include "tests/support/emulated/sciencemode/EmulatedStimulator.h"
#include "tests/support/usb_emulation/DeviceOnUsb.h"

namespace tacto::test {

class EmulatedOnUsb : public DeviceOnUsb<sciencemode::EmulatedStimulator> {
public:
    EmulatedOnUsb(UsbTestbed& bed, const Clock& clock, sciencemode::EmulatedSettings settings = {})
        : DeviceOnUsb(bed, clock, cdcAcmDevice(0x0483, 0x5740, "P24-EMU-1"), [settings = std::move(settings)](Instant) {
              return std::make_unique<sciencemode::EmulatedStimulator>(settings);
          }) {}
    /// Returns the number of pulses since the device was plugged in.
    [[nodiscard]] std::size_t pulses() {
        return inspect([](auto& device, Instant now) { return device.pulses(now).size(); });
    }
};

}  // namespace tacto::test
