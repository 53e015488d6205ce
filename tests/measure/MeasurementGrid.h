// MeasurementGrid.h - measures pulses of known truth with noise, few samples, coarse steps, ringing and drift, and
// finds the errors of the readings.
//
// Each grid point is measured on many records with different noise and sample positions. The result is the bias and
// spread of every figure, and the number of pulses missed, invented, or refused with a flag.
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
    double rangeShare = 0;  ///< plateau's share of the range of an 8-bit converter; 0 = no steps
    double ringing = 0;     ///< first overshoot, as a fraction
    double slope = 0;       ///< drift over the record, relative to the plateau
    double hum = 0;         ///< 50 Hz amplitude, relative to the plateau
    double offset = 0;      ///< relative to the plateau
    double interval = 20;   ///< onset to onset in widths: the reciprocal of the duty
    int pulses = 6;
    int polarity = 1;
};

/// Returns phases of level 40, width 200 µs and gap 100 µs. A recharge is a tenth as high and ten times as long.
[[nodiscard]] std::vector<SyntheticPhase> phasesOf(const GridPoint& point, double firstOnset_s);

/// The figures of science.md section 8, computed from the phase's formula and not from samples.
struct PhaseTruth {
    double plateau, onset_s, end_s, charge;
};
[[nodiscard]] PhaseTruth truthOf(const SyntheticPhase& phase);

/// Errors of the measured pulses: amplitude and charge relative, times in samples, imbalance absolute.
struct GridResult {
    Statistics amplitude, width, interval, gap, charge, imbalance;
    MeasurementUncertainty stated;  ///< k = 1, from the last record that was measured
    double rate_hz = 0;
    int records = 0;
    int pulses = 0;    ///< pulses in the records
    int missed = 0;    ///< pulses neither measured nor flagged
    int flagged = 0;   ///< pulses found and flagged as not measurable
    int invented = 0;  ///< pulses measured where there was none
    int warned = 0;    ///< records with at least one warning
    int silent = 0;    ///< records with a missed, invented or half-lost pulse and no warning
    // Readings, of `amplitude.n` (`gap.n`), with an error above kCoverage times the stated uncertainty.
    int beyondAmplitude = 0, beyondWidth = 0, beyondCharge = 0, beyondGap = 0, beyondImbalance = 0;
};
[[nodiscard]] GridResult measureGridPoint(const GridPoint& point, int seeds);

/// Describes the point: "symmetric, 100 samples, 40 dB, ringing 10 %".
[[nodiscard]] std::string describe(const GridPoint& point);

}  // namespace tacto::test
