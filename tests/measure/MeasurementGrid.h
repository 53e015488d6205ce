// MeasurementGrid.h - the measuring stick: pulses of known truth under noise, few samples, coarse steps, ringing and
// drift, and how far the readings are from that truth.
//
// One grid point is measured on many records that differ in their noise and in where the samples fall. The result is
// bias and spread of every figure, and how many pulses were missed, invented, or refused with a flag.
//
// Thread-safety: pure functions.
#pragma once

#include <string>
#include <vector>

#include "core/base/Statistics.h"
#include "core/measure/PulseMeasurement.h"
#include "tests/measure/SyntheticPulses.h"

namespace tacto::test {

enum class PulseShape { Monophasic, Symmetric, Recharge, Exponential, Logic };

struct GridPoint {
    PulseShape shape = PulseShape::Symmetric;
    double perPhase = 100;  ///< samples in the leading phase, 200 µs
    double snr_db = 60;     ///< 20·log10(leading plateau / noise s.d.)
    double rangeShare = 0;  ///< 8-bit steps with the plateau at this share of the range; 0 = no steps
    double ringing = 0;     ///< first overshoot
    double slope = 0;       ///< drift over the record, in plateaus
    double hum = 0;         ///< 50 Hz, in plateaus
    double offset = 0;      ///< in plateaus
    double interval = 20;   ///< onset to onset in widths; a duty of its reciprocal
    int pulses = 6;
    int polarity = 1;
};

/// Level 40, width 200 µs, gap 100 µs; the recharge is a tenth as high and ten times as long.
[[nodiscard]] std::vector<SyntheticPhase> phasesOf(const GridPoint& point, double firstOnset_s);

/// The figures that science.md section 8 defines, computed from the phase's formula and not from samples.
struct PhaseTruth {
    double plateau, onset_s, end_s, charge;
};
[[nodiscard]] PhaseTruth truthOf(const SyntheticPhase& phase);

/// Errors of the measured pulses: amplitude and charge relative, times in samples, imbalance absolute.
struct GridResult {
    Statistics amplitude, width, interval, gap, charge, imbalance;
    MeasurementUncertainty stated;  ///< k = 1, of the last record that was measured
    double rate_hz = 0;
    int records = 0;
    int pulses = 0;    ///< pulses that were there
    int missed = 0;    ///< pulses that were neither measured nor flagged
    int flagged = 0;   ///< found, and said not to be measurable
    int invented = 0;  ///< measured where there was none
    int warned = 0;    ///< records with any warning
    int silent = 0;    ///< records with a missed or invented pulse, or half a biphasic one, and no warning
    // Readings further from the truth than kCoverage times the stated uncertainty, of `amplitude.n` (`gap.n`).
    int beyondAmplitude = 0, beyondWidth = 0, beyondCharge = 0, beyondGap = 0, beyondImbalance = 0;
};
[[nodiscard]] GridResult measureGridPoint(const GridPoint& point, int seeds);

/// The point in a few words: "symmetric, 100 samples, 40 dB, ringing 10 %".
[[nodiscard]] std::string describe(const GridPoint& point);

}  // namespace tacto::test
