// RecordPlan.h - turns ScopeSettings into the settings of a libsigrok device, or says why the device cannot do them.
//
// Instruments (devices with a time base) sample a whole screen: `divisions` times the time per division. The plan takes
// the shortest screen that holds the wanted record at a whole multiple of the wanted sampling rate; averaging then
// reduces the samples to the wanted rate, which lowers the noise and never the resolution.
//
// A "Memory" record is a single shot: the instrument is started, triggers, stops, and is read. "Live" reads the screen
// of a running instrument: this is quicker if the memory is large, but may read a record twice, so a record that equals
// the one before is taken for the same record.
//
// libsigrok does not give the rate of a record from memory: it is record length / (divisions * time per division) while
// the converter keeps up. Lengths, from libsigrok's rigol-ds driver 0.5.2: DS1000D/E 1048576 samples, DS2000(A) and
// MSO2000A 14000, DSO1000A 20480, DS1000Z and MSO1000Z 12000000, shared by the channels that are on. The slowest
// converter gives 500 MS/s on two channels (data sheets of DS1000E and DS1000Z): the plan never uses more.
#pragma once

#include <optional>

#include "core/base/Result.h"
#include "core/devices/Oscilloscope.h"
#include "drivers/sigrok/protocol/Abilities.h"
#include "drivers/sigrok/protocol/ScopeUri.h"

namespace tacto::sigrok_driver {

/// The channels in use.
struct Wiring {
    std::size_t voltage = 0;             ///< index into Abilities::channels
    std::optional<std::size_t> current;  ///< index into Abilities::channels
    Ohms shunt{0};
    std::optional<std::uint64_t> voltageProbe, currentProbe;
    bool falling = false;
    bool ownTrigger = false;
    bool live = false;
};

struct RecordPlan {
    ScopeSettings settings;
    // For instruments:
    Fraction timebase;
    std::optional<Fraction> voltageScale, currentScale;  ///< volts per division
    std::string triggerSource;
    double triggerPosition = 0;  ///< in the units that libsigrok's driver expects
    double triggerAt_s = 0;      ///< from the record's start to the expected trigger
    double screen_s = 0;         ///< divisions * timebase
    std::size_t record = 0;      ///< samples of each channel in a record; 0: unknown until the first record
    // For instruments and streams:
    double triggerLevel_V = 0;  ///< signed, at the trigger channel's probe
};

/// Returns the memory in samples of this Rigol or Agilent model, or 0 for an unknown model.
[[nodiscard]] std::size_t memoryOf(std::string_view driver, std::string_view model) noexcept;

/// Errors: InvalidArgument naming a missing channel, or a probe factor or source that cannot be set, and the choices.
[[nodiscard]] Result<Wiring> wire(const ScopeUri& uri, const Abilities& abilities);

[[nodiscard]] ScopeTraits traitsOf(const Abilities& abilities, const Wiring& wiring);

/// Errors: InvalidArgument naming the setting, its value and the values that the device accepts.
[[nodiscard]] Result<RecordPlan> planRecord(const ScopeSettings& settings, const Abilities& abilities,
                                            const Wiring& wiring);

}  // namespace tacto::sigrok_driver
