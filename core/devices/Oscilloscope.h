// Oscilloscope.h - two channels on the load: the voltage across it, and its current through a shunt.
//
// Thread-safety: one caller, the device's session thread.
#pragma once

#include <optional>
#include <string_view>

#include "core/base/Result.h"
#include "core/devices/Device.h"
#include "core/measure/Capture.h"

namespace tacto {

struct ScopeSettings {
    Hertz sampleRate{2e6};
    std::size_t samples = 20'000;   ///< number of samples per channel and capture
    double preTrigger = 0.1;        ///< part of the record that lies before the trigger, 0..1
    bool triggerOnCurrent = false;  ///< false: triggers on the voltage channel
    double triggerLevel = 0.5;      ///< V or A; triggers when |signal| rises through this level
    Volts voltageRange{50};         ///< the channel shows ± this voltage
    Milliamps currentRange{200};    ///< the channel shows ± this current
};

struct ScopeTraits {
    Hertz maxRate{0};
    std::size_t memoryDepth = 0;  ///< samples per channel
    int bits = 8;
    Hertz bandwidth{0};
};

class Oscilloscope : public Device {
public:
    [[nodiscard]] virtual const ScopeTraits& traits() const noexcept = 0;
    /// Sets the settings for the next arm(). Errors: InvalidArgument naming the setting and its range.
    [[nodiscard]] virtual Result<void> configure(const ScopeSettings& settings) = 0;
    /// Waits for triggers from now on; each trigger makes a capture until disarm().
    [[nodiscard]] virtual Result<void> arm() = 0;
    /// Returns the oldest complete capture, or nothing yet. Errors: Device, Timeout.
    [[nodiscard]] virtual Result<std::optional<Capture>> poll() = 0;
    virtual void disarm() noexcept = 0;
};

/// A source of known voltages that can drive the oscilloscope's voltage input without a person; without such a source,
/// the operator is asked to connect one. 0 removes the voltage.
class VoltageReference {
public:
    virtual ~VoltageReference() = default;
    [[nodiscard]] virtual Result<void> applyVoltage(double volts) = 0;
};

/// A bench that can change its load without a person; without it, the operator is asked to change the load.
/// The text is in the form that parseLoad() reads: "500 ohm", "open", "200 ohm + 10 kohm || 50 nF".
class LoadFitter {
public:
    virtual ~LoadFitter() = default;
    [[nodiscard]] virtual Result<void> fitLoad(std::string_view load) = 0;
};

// The ability of some oscilloscopes to take a record without a trigger.
//
// Separate from Oscilloscope, so that an instrument or driver without this ability need not implement it.

class ForcedTrigger {
public:
    virtual ~ForcedTrigger() = default;
    /// Takes one record as if a trigger came now, or as soon as the part before the trigger is filled after arm() or
    /// the last record. If a real trigger comes first, the record is a triggered one. poll() returns the record, with
    /// `untriggered` set if it was forced; the oscilloscope then waits for triggers again.
    /// Errors: Unsupported while not armed; Device, Timeout.
    [[nodiscard]] virtual Result<void> forceTrigger() = 0;
};

}  // namespace tacto
