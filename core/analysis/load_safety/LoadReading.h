// LoadReading.h - what a train did to a load, measured on its captures in the quantities of science.md section 7.
//
// Every figure comes from the samples: levels and times from core/measure, charge, energy and squares by summing the
// record of each train from its own baseline, tail included. A figure that the record cannot carry (clipped, missing
// samples, no two states, no current channel, only one train) is NaN and says why; it is never replaced by a command.
//
// Uncertainty, science.md sections 9 and 12: gain, probe or shunt of each channel and the time base, as they are
// stated; resolution of a level above its baseline (an offset cancels there); noise over the samples that a figure is
// averaged over; and for what is the mean of the trains their spread, with its degrees of freedom. U (95 %) is
// combine()'s. What one instrument states is taken as fully correlated in products (energy, power). In the ratio V/I a
// gain error that both channels share divides out where the capture says that they share it (gainShared); elsewhere the
// two are taken as independent. A figure that rests on something not stated has a
// value and no U (H9). The voltage that a current source leaves on a capacitor still rises where a phase is read: it is
// followed in a straight line to the phase's end, and a fifth of that way is in doubt (an exponential bends away from
// its tangent by no more as long as it still rises by a hundredth). A peak also carries the largest step between
// neighbours/√12: a spike may stand between two samples.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/statistics/UncertaintyBudget.h"
#include "core/base/DriveSegment.h"
#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/measure/Capture.h"

namespace tacto {

/// A value with its uncertainty, all in one unit. A value that is NaN was not measured; an uncertainty that is NaN is
/// not known.
struct Reading {
    double value = kNaN;
    double u = kNaN;         ///< standard, k = 1
    double expanded = kNaN;  ///< 95 %
    /// Value and U: what can be judged.
    [[nodiscard]] bool measured() const noexcept;
};

/// A value with the uncertainty of `rows`. Without any row the uncertainty is unknown; U is combine()'s.
[[nodiscard]] Reading readingOf(double value, std::vector<Contribution> rows, const BudgetOptions& budget);

/// The measurements of a load's trains: the largest of them, unless a line says otherwise.
struct LoadReading {
    Reading delivered;      ///< amplitude over what each train was to have, 1 = as programmed; mean
    Reading amplitude_v;    ///< plateau of the leading phase, magnitude; of a current source at its end; mean
    Reading highest_v;      ///< amplitude_v of the train with the highest
    Reading amplitude_ma;   ///< at the end of the leading phase, from 80 to 97 % of its width; mean
    Reading width_s;        ///< width of the leading phase, of what the source drives; mean
    Reading rate_hz;        ///< rate of the pulses in a train, from its first onset to its last; NaN for single pulses
    Reading interval_s;     ///< onset to onset of trains; the shortest
    Reading impedance_ohm;  ///< voltage over current at its end, as science.md section 4 means |Z|; mean
    Reading peak_v;         ///< largest |voltage|
    Reading peak_ma;        ///< largest |current|
    Reading charge_uc;      ///< the larger |charge| of either phase of a pulse
    Reading net_charge_uc;  ///< |charge| of a pulse, gap and tail included
    Reading imbalance;      ///< net_charge_uc / charge_uc, 0..
    Reading energy_mj;      ///< ∫v·i dt of a pulse
    Reading rms_train_ma;   ///< over n / the measured rate; of a single pulse over 1 / the programmed rate
    /// Over longer windows the trains seen are repeated at the measured interval: upper bounds, for one that the window
    /// touches counts whole.
    Reading rms_1s_ma;         ///< worst second
    Reading rms_5s_ma;         ///< worst 5 s
    Reading rms_5s_v;          ///< worst 5 s, V
    Reading dc_ma;             ///< |net charge| of the trains of 5 s / 5 s
    Reading power_1s_w;        ///< energy of the worst second / 1 s
    double currentLsb = 0;     ///< A; 0 = unknown
    bool biphasic = false;     ///< every pulse had a second phase
    bool underTenLsb = false;  ///< the current peaks below 10 LSB: nothing about current is evaluated
    std::size_t trains = 0;    ///< captures measured
    /// What figures without U lack, as a sentence's end: "the oscilloscope does not state the gain of voltage".
    std::string notStated;
    std::vector<std::string> warnings;
};

/// The intended trains in the captures: they tell a pulse's place in a record.
struct ExpectedTrain {
    int pulses = 1;
    double rate_hz = 100;  ///< intra-train
    /// The drive that the source imposes: its channel shows where the phases are. The other channel shows the load's
    /// answer, which on a capacitor outlasts the phase. Voltage or Current.
    Drive drive = Drive::Voltage;
    /// Amplitude that the device was to deliver in each capture, V or mA by its drive; empty = not known.
    std::vector<double> programmed{};
    /// The draws of every figure's interval: with two thousand draws U itself is known to half a percent, which its two
    /// digits do not show; a check has thousands of figures.
    BudgetOptions budget{.draws = 2000};
};

/// One capture per train, in time order, all with one command, on one time base. Channels "voltage" (V) and "current"
/// (A). A single capture leaves the interval and all windows longer than a train unmeasured.
/// `rhythm`: one record that holds at least two trains of the same command: the interval is taken from it, and not from
/// the time stamps of `captures`, where an instrument does not state how good those are.
/// `fine`: further trains of the same command in a current range that fits the end of a phase, where a skin
/// equivalent's charging spike clips. |Z|, net charge and imbalance are then read there, and in `captures` only while
/// `fine` clips. Errors: InvalidArgument without captures or for an expectation that is not above zero, or does not
/// fit the captures; NotFound
/// without a voltage channel, or without a current channel for a current source.
[[nodiscard]] Result<LoadReading> readLoad(std::span<const Capture> captures, const ExpectedTrain& expected,
                                           std::span<const Capture> fine = {}, const Capture* rhythm = nullptr);

}  // namespace tacto
