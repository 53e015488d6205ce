// LoadReading.h - the effect of a train on a load, measured in its captures as the quantities of science.md section 7.
//
// Every figure comes from the samples. core/measure finds levels and times; charge, energy and squares are sums over a
// train's record above its own baseline, tail included. A figure that the record does not allow (clipped, missing
// samples, no two states, no current channel, only one train) is NaN with a reason, never replaced by a command.
//
// Uncertainty (science.md sections 9 and 12) includes the stated gain, probe or shunt of each channel, the stated time
// base, the resolution of a level above its baseline (an offset cancels), the noise over the averaged samples and, for
// a mean of trains, their spread with its degrees of freedom. combine() gives U (95 %). In products (energy, power) the
// errors of one instrument are taken as fully correlated. In the ratio V/I a shared gain error cancels if the capture
// says that the channels share it (gainShared); otherwise the two errors are independent. A figure that depends on an
// unstated tolerance has a value but no U (H9). Behind a capacitor the voltage of a current source still rises while a
// phase is read: a straight line extends it to the end of the phase, and a fifth of that extension is uncertain (an
// exponential that still rises by a hundredth bends no further from its tangent). A peak also includes the largest step
// between neighbours/√12, because a spike may lie between two samples.
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

/// A value with its uncertainty, all in one unit. A NaN value was not measured; a NaN uncertainty is not known.
struct Reading {
    double value = kNaN;
    double u = kNaN;         ///< standard uncertainty, k = 1
    double expanded = kNaN;  ///< expanded uncertainty U, 95 %
    /// True if both value and U are known, so that the reading can be judged.
    [[nodiscard]] bool measured() const noexcept;
};

/// A value with the uncertainty of `rows`; combine() computes U. Without rows the uncertainty is unknown.
[[nodiscard]] Reading readingOf(double value, std::vector<Contribution> rows, const BudgetOptions& budget);

/// The measurements of a load's trains. Each figure is the largest over the trains unless its comment says otherwise.
struct LoadReading {
    Reading delivered;      ///< delivered amplitude / programmed amplitude; mean
    Reading amplitude_v;    ///< plateau of the leading phase, magnitude; for a current source, its end value; mean
    Reading highest_v;      ///< highest amplitude_v of any train
    Reading amplitude_ma;   ///< at the end of the leading phase, from 80 to 97 % of its width; mean
    Reading width_s;        ///< width of the leading phase, in the channel that the source drives; mean
    Reading rate_hz;        ///< rate of the pulses in a train, from its first onset to its last; NaN for single pulses
    Reading interval_s;     ///< shortest time from one train onset to the next
    Reading impedance_ohm;  ///< voltage / current at the end of the leading phase (|Z| in science.md section 4); mean
    Reading peak_v;         ///< largest |voltage|
    Reading peak_ma;        ///< largest |current|
    Reading charge_uc;      ///< the larger |charge| of the two phases of a pulse
    Reading net_charge_uc;  ///< |charge| of a pulse, gap and tail included
    Reading imbalance;      ///< net_charge_uc / charge_uc, ≥ 0
    Reading energy_mj;      ///< ∫v·i dt of a pulse
    Reading rms_train_ma;   ///< over pulses / measured rate; for a single pulse over 1 / programmed rate
    /// For the following windows the trains are repeated at the measured interval. The values are upper bounds, because
    /// a train that is only partly inside the window counts as a whole train.
    Reading rms_1s_ma;         ///< in the worst second
    Reading rms_5s_ma;         ///< in the worst 5 s
    Reading rms_5s_v;          ///< worst 5 s, in volts
    Reading dc_ma;             ///< |net charge| of the trains in 5 s, divided by 5 s
    Reading power_1s_w;        ///< energy of the worst second / 1 s
    double currentLsb = 0;     ///< one converter step in A; 0 = unknown
    bool biphasic = false;     ///< true if every pulse had a second phase
    bool underTenLsb = false;  ///< true if the current stays below 10 LSB; no current figure is then evaluated
    std::size_t trains = 0;    ///< number of measured captures
    /// Why some figures have no U, as the end of a sentence: "the oscilloscope does not state the gain of voltage".
    std::string notStated;
    std::vector<std::string> warnings;
};

/// The intended trains in the captures, used to find the pulses in a record.
struct ExpectedTrain {
    int pulses = 1;
    double rate_hz = 100;  ///< pulse rate within a train
    /// The quantity that the source imposes (voltage or current). Its channel shows where the phases are. The other
    /// channel shows the load's response, which outlasts the phase on a capacitor.
    Drive drive = Drive::Voltage;
    /// Amplitude that the device was to deliver in each capture, V or mA depending on `drive`; empty = not known.
    std::vector<double> programmed{};
    /// Random draws for every uncertainty interval. Two thousand draws give U to half a percent, which is finer than
    /// its two digits show; a check has thousands of figures.
    BudgetOptions budget{.draws = 2000};
};

/// Measures a load from one capture per train, in time order, all of one command and one time base. Channels: "voltage"
/// (V) and "current" (A). With a single capture, the interval and all windows longer than a train stay unmeasured.
/// `rhythm`: one record with at least two trains of the same command. It supplies the interval if the instrument does
/// not state the accuracy of the time stamps in `captures`. `fine`: further trains of the same command in a current
/// range that fits the end of a phase but clips a skin equivalent's charging spike. |Z|, net charge and imbalance then
/// come from `fine`, and from `captures` only while `fine` clips. Errors: InvalidArgument without captures, or for an
/// expectation that is not positive or does not fit the captures; NotFound without a voltage channel, or without a
/// current channel for a current source.
[[nodiscard]] Result<LoadReading> readLoad(std::span<const Capture> captures, const ExpectedTrain& expected,
                                           std::span<const Capture> fine = {}, const Capture* rhythm = nullptr);

}  // namespace tacto
