// Stimulator.h - a source of pulse trains. It accepts only what SafetyGate approved.
//
// Thread-safety: one caller, the device's session thread; only forceOff() may be called from any thread at any moment.
#pragma once

#include <cstdint>
#include <optional>

#include "core/devices/Device.h"
#include "core/encoding/StimulatorCalibration.h"
#include "core/safety/SafetyGate.h"
#include "core/safety/SourceTraits.h"

namespace tacto {

enum class ElectrodeState { NotMeasured, Ok, Open, Short };

struct StimulatorStatus {
    Instant at{0};            ///< when this status was read from the device
    bool delivering = false;  ///< true while a train is in progress
    /// When that train ends, if the driver knows this better than from the onset: pulses that the host sends one by one
    /// may be late.
    std::optional<Instant> trainEnd = {};
    ElectrodeState electrode = ElectrodeState::NotMeasured;
    std::optional<double> amplitude;  ///< V or mA by drive, as the device measured it at the end of the leading phase
    std::optional<Ohms> impedance;    ///< |Z| at the end of the leading phase of the last pulse (science.md section 4)
    std::optional<double> imbalance;  ///< |net charge| / phase charge of the last pulse, including its tail
    std::optional<double> imbalanceUncertainty;  ///< uncertainty of `imbalance`, 95 %
    std::uint64_t trainsDelivered = 0;
};

class Stimulator : public Device {
public:
    [[nodiscard]] virtual const SourceTraits& traits() const noexcept = 0;

    /// Starts one train now; it ends by itself. Returns once the device has accepted it, without waiting for its end.
    /// Uses up the approval in any case. Errors: Device (gone, garbage, refused), Timeout (no answer in 50 ms, or the
    /// approval has expired). On error the caller calls forceOff().
    [[nodiscard]] virtual Result<void> deliver(ApprovedTrain&& train) = 0;

    /// Errors: Device, Timeout.
    [[nodiscard]] virtual Result<StimulatorStatus> status() = 0;

    /// Keeps the device's dead-man switch from acting. Does nothing on a device without one.
    [[nodiscard]] virtual Result<void> keepAlive() = 0;

    /// Switches output off now. Needs no approval; never throws or allocates; any thread, any number of times.
    virtual void forceOff() noexcept = 0;
};

// A simulated stimulator, which knows its own calibration. The bench accepts a stated calibration from no other
// device.

/// Implemented in addition to Stimulator.
class StatesCalibration {
public:
    virtual ~StatesCalibration() = default;
    /// Returns nothing if the simulated stimulator is deliberately out of order.
    [[nodiscard]] virtual const KnownLines& statedCalibration() const noexcept = 0;
};

// A vibration motor that replaces the electrodes and is driven by the same encoder.

class Massager : public Device {
public:
    /// Starts one vibration burst now; it ends by itself. Uses up the approval in any case. Errors: Device, Timeout (no
    /// answer in time, or the approval has expired). On error the caller calls forceOff().
    [[nodiscard]] virtual Result<void> vibrate(ApprovedBurst&& burst) = 0;
    /// Returns the smallest step between two intensities (0 to 1) that the device can set; 0: any. Constant while open.
    [[nodiscard]] virtual double step() const noexcept = 0;
    /// Sends the report that stops the motor. Never throws or allocates.
    virtual void forceOff() noexcept = 0;
};

}  // namespace tacto
