// Oscilloscope.h - two channels on the load: voltage across it, current by shunt.
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
    std::size_t samples = 20'000;   ///< per channel and capture
    double preTrigger = 0.1;        ///< fraction of the record before the trigger, 0..1
    bool triggerOnCurrent = false;  ///< false: it triggers on the voltage channel
    double triggerLevel = 0.5;      ///< V or A; the trigger fires where |signal| rises through it
    Volts voltageRange{50};         ///< full scale is ± this
    Milliamps currentRange{200};    ///< full scale is ± this
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
    /// Applies settings; takes effect at the next arm(). Errors: InvalidArgument naming the setting and its range.
    [[nodiscard]] virtual Result<void> configure(const ScopeSettings& settings) = 0;
    /// Waits for triggers from now on; each trigger makes a capture until disarm().
    [[nodiscard]] virtual Result<void> arm() = 0;
    /// The oldest complete capture, or nothing yet. Errors: Device, Timeout.
    [[nodiscard]] virtual Result<std::optional<Capture>> poll() = 0;
    virtual void disarm() noexcept = 0;
};

/// A voltage of known size that can be put on the oscilloscope's voltage input without a person; without it the
/// operator is asked to connect a source. 0 takes it away.
class VoltageReference {
public:
    virtual ~VoltageReference() = default;
    [[nodiscard]] virtual Result<void> applyVoltage(double volts) = 0;
};

/// A bench whose load can be changed without a person; without it the operator is asked to.
/// The text is what parseLoad() reads: "500 ohm", "open", "200 ohm + 10 kohm || 50 nF".
class LoadFitter {
public:
    virtual ~LoadFitter() = default;
    [[nodiscard]] virtual Result<void> fitLoad(std::string_view load) = 0;
};

// An ability of some oscilloscopes: to take a record without a trigger.
//
// It is not a part of Oscilloscope: an instrument or a driver without the ability does not implement it.

class ForcedTrigger {
public:
    virtual ~ForcedTrigger() = default;
    /// Takes one record as if a trigger came now, or as soon as the record's part before the trigger has passed since
    /// arm() or the last record. A true trigger that comes before then makes a triggered record instead. poll() gives
    /// it like any other, with `untriggered` set. After it the oscilloscope waits for triggers again.
    /// Errors: Unsupported while not armed; Device, Timeout.
    [[nodiscard]] virtual Result<void> forceTrigger() = 0;
};

}  // namespace tacto
