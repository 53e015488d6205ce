// TwinRuns.h - trains of a simulated stimulator with known truth, captured by a simulated oscilloscope. Its gain,
// offset, linearity, shunt and time base are drawn for each seed within its specification (science.md section 12).
//
// Thread-safety: as SimBench.
#pragma once

#include <string>
#include <vector>

#include "core/base/Random.h"
#include "tests/drivers/SimBench.h"

namespace tacto::test {

/// The true values of the stimulator, drawn for each seed.
struct TwinTruth {
    explicit TwinTruth(std::uint64_t seed);
    double gain, offset_v;  ///< errors of the amplitude
    double width_s, gap_s;  ///< added to each phase's width, and to the gap
    double imbalance;       ///< share by which the second phase is weaker
    double ohms;            ///< the load's resistance
    double train_hz;        ///< commanded rate within a train: onsets are not a whole number of samples apart
    [[nodiscard]] double volts(double commanded) const { return gain * commanded + offset_v; }
};

class TwinRuns {
public:
    /// `oscilloscope`: more keys for its address. Without noise, the converter's steps have their full effect.
    explicit TwinRuns(std::uint64_t seed, const std::string& oscilloscope = "noise=1e-5");

    const TwinTruth truth;
    /// Captures one train that begins anywhere between two samples.
    [[nodiscard]] Capture captured(const PulseTrain& train, double range_v);
    /// Captures several trains on one time base, with `intervals_s` from onset to onset.
    [[nodiscard]] std::vector<Capture> captured(const std::vector<PulseTrain>& trains, double range_v,
                                                const std::vector<double>& intervals_s);

private:
    SimBench bench_;
    Random onsets_;
};

/// Returns a biphasic train.
[[nodiscard]] PulseTrain twinTrain(double volts, double width_us = 200, double gap_us = 100, int pulses = 1,
                                   double rate_hz = 1000);

}  // namespace tacto::test
