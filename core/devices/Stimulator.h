// Stimulator.h - a source of pulse trains. It accepts only what SafetyGate approved.
//
// Thread-safety: one caller, the device's session thread, except forceOff(), which any thread may call at
// any moment.
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
    Instant at{0};            ///< when the device was read
    bool delivering = false;  ///< a train is in progress
    /// When that train ends, where the driver knows better than from its onset: pulses that the host sends one by one
    /// may slip.
    std::optional<Instant> trainEnd = {};
    ElectrodeState electrode = ElectrodeState::NotMeasured;
    std::optional<double> amplitude;  ///< V or mA by drive: the leading phase's end, as the device measured it
    std::optional<Ohms> impedance;    ///< |Z| at the end of the leading phase of the last pulse (science.md section 4)
    std::optional<double> imbalance;  ///< |net charge| / phase charge of the last pulse, tail included
    std::optional<double> imbalanceUncertainty;  ///< uncertainty of `imbalance`, 95 %
    std::uint64_t trainsDelivered = 0;
};

class Stimulator : public Device {
public:
    [[nodiscard]] virtual const SourceTraits& traits() const noexcept = 0;

    /// Starts one train now; it ends by itself. Returns when the device has accepted it, without waiting for its end.
    /// Consumes the approval in any case. Errors: Device (gone, garbage, refused), Timeout (no answer in 50 ms, or the
    /// approval has expired). On error the caller calls forceOff().
    [[nodiscard]] virtual Result<void> deliver(ApprovedTrain&& train) = 0;

    /// Errors: Device, Timeout.
    [[nodiscard]] virtual Result<StimulatorStatus> status() = 0;

    /// Holds off the device's dead-man switch. A device without one does nothing.
    [[nodiscard]] virtual Result<void> keepAlive() = 0;

    /// Output off, now. Needs no approval; never throws, never allocates, may be called from any thread and again.
    virtual void forceOff() noexcept = 0;
};

// A stimulator that knows its own calibration, because it is simulated. The bench believes no
// other.

/// Implemented beside Stimulator.
class StatesCalibration {
public:
    virtual ~StatesCalibration() = default;
    /// Nothing where it does not know: it is out of order on purpose.
    [[nodiscard]] virtual const KnownLines& statedCalibration() const noexcept = 0;
};

// A vibration motor in place of the electrodes, driven by the same encoder.

class Massager : public Device {
public:
    /// Starts one vibration burst now; it ends by itself. Consumes the approval in any case. Errors: Device, Timeout
    /// (no answer in time, or the approval has expired). On error the caller calls forceOff().
    [[nodiscard]] virtual Result<void> vibrate(ApprovedBurst&& burst) = 0;
    /// The smallest difference of two intensities that the device can tell, to 1; 0: it takes any. Constant while open.
    [[nodiscard]] virtual double step() const noexcept = 0;
    /// Sends the stop report. Never throws or allocates.
    virtual void forceOff() noexcept = 0;
};

}  // namespace tacto
