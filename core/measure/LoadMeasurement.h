// LoadMeasurement.h - what the pulses met: load, charge, energy and impedance from the voltage and the current of one
// capture.
//
// Pulses are those of the current channel as measureChannel() finds them; a pulse that was not measured there, or whose
// voltage is clipped or incomplete, has no numbers here. The voltage counts from its mean in the silence just before
// each pulse (up to two widths), so that the offset of a probe and a charge left on an electrode do not become load.
//
//   load       voltage over current at the end of the leading phase, both by a straight line through its second half:
//              for a resistor its resistance, for a capacitor in series R + width / C
//   impedance  root mean square of the voltage over that of the current within the phases, noise taken out: what a
//              meter would call |Z| of this waveform
//   energy     ∫ v·i over the pulse, both phases and the gap: what stays in the load; a charged capacitor that is
//              discharged by the second phase gives its share back
//
// Values are bare doubles in the SI unit that their name ends in, because they stand in Statistics beside those of
// core/measure/PulseMeasurement.h.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto {

/// NaN where not measured.
struct PulseLoad {
    double onset_s = kNotMeasured;
    double voltage_v = kNotMeasured;  ///< at the end of the leading phase, with its sign
    double current_a = kNotMeasured;  ///< at the end of the leading phase, with its sign
    double load_ohm = kNotMeasured;   ///< negative when a probe is the wrong way round
    double impedance_ohm = kNotMeasured;
    double charge_c = kNotMeasured;        ///< charge of the leading phase, with its sign
    double secondCharge_c = kNotMeasured;  ///< charge of the second phase; NaN without one
    double netCharge_c = kNotMeasured;     ///< sum of both
    double energy_j = kNotMeasured;
};

struct LoadMeasurement {
    std::string voltage;  ///< names of the channels
    std::string current;
    std::vector<PulseLoad> pulses;  ///< one per pulse of the current, in time order
    std::size_t measuredPulses = 0;
    double loadUncertainty_ohm = kNotMeasured;  ///< standard uncertainty (k = 1) of one reading

    // Statistics of the measured pulses; charges by magnitude, the net charge with its sign.
    Statistics load_ohm;
    Statistics impedance_ohm;
    Statistics charge_c;
    Statistics secondCharge_c;
    Statistics netCharge_c;
    Statistics energy_j;
    std::vector<std::string> warnings;  ///< whole sentences that name the channels
};

/// `voltage` and `current` index channels in V and A of the same capture. No pulses is a warning, not an error.
/// Errors: InvalidArgument when an index is beyond the channels or a channel is in another unit.
[[nodiscard]] Result<LoadMeasurement> measureLoad(const Capture& capture, std::size_t voltage, std::size_t current,
                                                  const MeasureOptions& options = {});

/// The load of each current pulse in `measured`, the result of measureChannel() for `current`, for a caller that has it
/// already. The channels must be in V and A.
[[nodiscard]] std::vector<PulseLoad> loadOfPulses(const Capture& capture, std::size_t voltage, std::size_t current,
                                                  const ChannelMeasurement& measured);

/// The channels to measure a load from: the only one in V and the only one in A. None if there are several or none.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> loadChannels(const Capture& capture);

}  // namespace tacto
