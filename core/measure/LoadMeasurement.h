// LoadMeasurement.h - measures load, charge, energy and impedance from the voltage and the current of one capture.
//
// The pulses are those that measureChannel() finds in the current. A pulse has no numbers here if it was not measured
// there, or if its voltage is clipped or incomplete. The zero of the voltage is its mean in the silence just before
// each pulse (up to two widths), so that a probe's offset and charge left on an electrode do not change the load.
//
//   load       voltage over current at the end of the leading phase, both by a straight line through its second half:
//              for a resistor its resistance, for a capacitor in series R + width / C
//   impedance  root mean square of the voltage over that of the current within the phases, noise taken out: what a
//              meter would call |Z| of this waveform
//   energy     ∫ v·i over the pulse (both phases and the gap): the energy that stays in the load; a capacitor that
//              the second phase discharges gives its share back
//
// Values are bare doubles in the SI unit at the end of their name, so that they fit into Statistics, as in
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

/// Load values of one pulse; NaN if not measured.
struct PulseLoad {
    double onset_s = kNotMeasured;
    double voltage_v = kNotMeasured;  ///< at the end of the leading phase, with its sign
    double current_a = kNotMeasured;  ///< at the end of the leading phase, with its sign
    double load_ohm = kNotMeasured;   ///< negative if a probe is reversed
    double impedance_ohm = kNotMeasured;
    double charge_c = kNotMeasured;        ///< charge of the leading phase, with its sign
    double secondCharge_c = kNotMeasured;  ///< charge of the second phase; NaN if there is none
    double netCharge_c = kNotMeasured;     ///< sum of both charges
    double energy_j = kNotMeasured;
};

struct LoadMeasurement {
    std::string voltage;  ///< names of the channels
    std::string current;
    std::vector<PulseLoad> pulses;  ///< one per pulse of the current channel, in time order
    std::size_t measuredPulses = 0;
    double loadUncertainty_ohm = kNotMeasured;  ///< standard uncertainty (k = 1) of one reading

    // Statistics of the measured pulses. Charges are magnitudes; the net charge keeps its sign.
    Statistics load_ohm;
    Statistics impedance_ohm;
    Statistics charge_c;
    Statistics secondCharge_c;
    Statistics netCharge_c;
    Statistics energy_j;
    std::vector<std::string> warnings;  ///< whole sentences that name the channels
};

/// `voltage` and `current` are the indices of channels in V and A of the same capture. A capture without pulses gives a
/// warning, not an error. Errors: InvalidArgument for an index beyond the channels or a channel in another unit.
[[nodiscard]] Result<LoadMeasurement> measureLoad(const Capture& capture, std::size_t voltage, std::size_t current,
                                                  const MeasureOptions& options = {});

/// Returns the load of each pulse in `measured`, which measureChannel() returned for `current`. For a caller that has
/// this result already. The channels must be in V and A.
[[nodiscard]] std::vector<PulseLoad> loadOfPulses(const Capture& capture, std::size_t voltage, std::size_t current,
                                                  const ChannelMeasurement& measured);

/// Returns the only channel in V and the only channel in A; nothing if there are several or none of either.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> loadChannels(const Capture& capture);

}  // namespace tacto
