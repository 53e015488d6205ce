// RecordPlan.h - turns ScopeSettings into the settings of a libsigrok device, or into the reason why it cannot.
//
// Instruments (those with a time base) sample a whole screen: `divisions` times the time per division, with as many
// samples as the record has. The plan takes the shortest screen that holds the record wanted, at a sampling rate that
// is a whole multiple of the one wanted; the multiple is averaged away, which makes the channel quieter, never coarser.
//
// Each record is a single shot ("Memory"): the instrument is started, triggers, stops, and is read. "Live" reads the
// screen of an instrument that goes on: quicker where the memory is large, but a record may be seen twice, so that one
// that looks exactly like the one before it is taken for the same.
//
// The rate of a record from memory is not in libsigrok: it is record length / (divisions * time per division) while the
// converter keeps up. Lengths, from libsigrok's rigol-ds driver 0.5.2: DS1000D/E 1048576 samples, DS2000(A) and
// MSO2000A 14000, DSO1000A 20480, DS1000Z and MSO1000Z 12000000, shared by the channels that are on. Its slowest
// converter gives 500 MS/s on two channels (data sheets of DS1000E and DS1000Z), so no more is planned.
#pragma once

#include <optional>

#include "core/base/Result.h"
#include "core/devices/Oscilloscope.h"
#include "drivers/sigrok/protocol/Abilities.h"
#include "drivers/sigrok/protocol/ScopeUri.h"

namespace tacto::sigrok_driver {

/// The channels in use, and their purposes.
struct Wiring {
    std::size_t voltage = 0;             ///< index into Abilities::channels
    std::optional<std::size_t> current;  ///< likewise
    Ohms shunt{0};
    std::optional<std::uint64_t> voltageProbe, currentProbe;
    bool falling = false;
    bool ownTrigger = false;
    bool live = false;
};

struct RecordPlan {
    ScopeSettings settings;
    // Instruments:
    Fraction timebase;
    std::optional<Fraction> voltageScale, currentScale;  ///< volts per division
    std::string triggerSource;
    double triggerPosition = 0;  ///< as libsigrok's driver takes it
    double triggerAt_s = 0;      ///< from the record's start to the expected trigger
    double screen_s = 0;         ///< divisions * timebase
    std::size_t record = 0;      ///< samples of each channel in a record; 0 unknown until the first
    // Both:
    double triggerLevel_V = 0;  ///< signed, at the trigger channel's probe
};

/// Samples of the memory of this Rigol or Agilent model; 0 for one that is not known.
[[nodiscard]] std::size_t memoryOf(std::string_view driver, std::string_view model) noexcept;

/// Errors: InvalidArgument naming a channel that is not there, a probe factor or a source that cannot be set, and what
/// there is.
[[nodiscard]] Result<Wiring> wire(const ScopeUri& uri, const Abilities& abilities);

[[nodiscard]] ScopeTraits traitsOf(const Abilities& abilities, const Wiring& wiring);

/// Errors: InvalidArgument naming the setting, its value and what the device takes.
[[nodiscard]] Result<RecordPlan> planRecord(const ScopeSettings& settings, const Abilities& abilities,
                                            const Wiring& wiring);

}  // namespace tacto::sigrok_driver
