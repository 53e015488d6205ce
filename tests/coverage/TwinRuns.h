// TwinRuns.h - trains of a simulated stimulator with known truth, as a simulated oscilloscope sees them; its gain,
// offset, linearity, shunt and time base are drawn for each seed within what it states (science.md section 12).
//
// Thread-safety: as SimBench.
#pragma once

#include <string>
#include <vector>

#include "core/base/Random.h"
#include "tests/drivers/SimBench.h"

namespace tacto::test {

/// The truth about the stimulator, drawn for each seed.
struct TwinTruth {
    explicit TwinTruth(std::uint64_t seed);
    double gain, offset_v;  ///< errors of the amplitude
    double width_s, gap_s;  ///< added to both
    double imbalance;       ///< the second phase is weaker by this share
    double ohms;            ///< the load's resistance
    double train_hz;        ///< the commanded rate within a train: no whole number of samples from onset to onset
    [[nodiscard]] double volts(double commanded) const { return gain * commanded + offset_v; }
};

class TwinRuns {
public:
    /// `oscilloscope`: further keys of its address. The converter's steps are met in full: without noise nothing
    /// dithers them.
    explicit TwinRuns(std::uint64_t seed, const std::string& oscilloscope = "noise=1e-5");

    const TwinTruth truth;
    /// The capture of one train, that begins anywhere between two samples.
    [[nodiscard]] Capture captured(const PulseTrain& train, double range_v);
    /// Captures of several trains, with `intervals_s` from onset to onset, on one time base.
    [[nodiscard]] std::vector<Capture> captured(const std::vector<PulseTrain>& trains, double range_v,
                                                const std::vector<double>& intervals_s);

private:
    SimBench bench_;
    Random onsets_;
};

/// Biphasic, 200 µs a phase unless said otherwise.
[[nodiscard]] PulseTrain twinTrain(double volts, double width_us = 200, double gap_us = 100, int pulses = 1,
                                   double rate_hz = 1000);

}  // namespace tacto::test
