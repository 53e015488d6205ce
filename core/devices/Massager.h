// Massager.h - a vibration motor in place of the electrodes, driven by the same encoder.
//
// Thread-safety: one caller, except forceOff(), which any thread may call at any moment.
#pragma once

#include "core/devices/Device.h"
#include "core/safety/SafetyGate.h"

namespace tacto {

class Massager : public Device {
public:
    /// Starts one vibration burst now; it ends by itself. Consumes the approval whatever happens.
    /// Errors: Device, Timeout (no answer in time, or the approval has expired). On error the caller calls forceOff().
    [[nodiscard]] virtual Result<void> vibrate(ApprovedBurst&& burst) = 0;
    /// The smallest difference of two intensities that the device can tell, to 1; 0: it takes any. Constant while open.
    [[nodiscard]] virtual double step() const noexcept = 0;
    /// Sends the stop report. Never throws or allocates.
    virtual void forceOff() noexcept = 0;
};

}  // namespace tacto
