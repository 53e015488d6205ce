// ExposureRun.h - internal: one train through a load, from each state that the load may be in, as sums.
//
// Thread-safety: pure functions; nothing allocates.
#pragma once

#include <array>
#include <cmath>

#include "core/electrode/LoadResponse.h"
#include "core/safety/TrainExposure.h"

namespace tacto::exposure {

/// Returns the larger value; NaN wins, so that it leads to a refusal and is not lost.
[[nodiscard]] inline double larger(double a, double b) noexcept { return std::isnan(a) || a > b ? a : b; }

/// Integrals over a stretch of time; every integrand is 0 or more.
struct Sums {
    double squares = 0;     // ∫i², A²s
    double volts = 0;       // ∫v², V²s
    double dissipated = 0;  // energy minus the energy that the capacitor kept, J
    Sums& operator+=(const Sums& other) noexcept {
        squares += other.squares;
        volts += other.volts;
        dissipated += other.dissipated;
        return *this;
    }
};
[[nodiscard]] inline Sums larger(const Sums& a, const Sums& b) noexcept {
    return {larger(a.squares, b.squares), larger(a.volts, b.volts), larger(a.dissipated, b.dissipated)};
}

/// The sums over one run of a train, starting with a given voltage on the load's capacitor.
struct Run {
    double peakVoltage = 0, peakCurrent = 0, phaseCharge = 0;  // largest of any pulse
    double netCharge = 0, energy = 0;                          // largest of any pulse with its rest
    // A stretch of n periods holds at most n times `pulse` (part by part the largest of any pulse) plus `cut`: it may
    // begin within a part of one pulse and end in the same part of another.
    Sums pulse, cut;
    Sums cutTrain;             // the same as `cut` for whole trains, which may find the load in different states
    TrainSums inDuration;      // the sums over the n periods of the train, n / rate
    TrainSums whole;           // the sums including the rest until the next train
    double endOfTrain = 0;     // voltage of the capacitor after n / rate, V
    double endOfInterval = 0;  // its voltage when the next train begins, V
};

/// Everything that a run needs except its start; constant while one exposure is computed.
struct Plan {
    Circuit circuit;
    PulseSegments pulse;
    DriveSegment betweenPulses;
    std::array<double, 3> leastPulse_s{};  // each segment's length in the sparsest train of the range
    double mostBetweenPulses_s = 0;        // the longest rest between pulses of that train
    DriveSegment afterTrain;
    double leastAfterTrain_s = 0;  // rest after the sparsest train of the range, which has the longest pulses
    int pulses = 1;
    SourceLimits limits;  // infinite: output lost by clipping is still included
};

/// Returns how long each segment of `densest` lasts in the sparsest train, which may have no gap; in s.
[[nodiscard]] std::array<double, 3> leastDurations(const PulseSegments& densest,
                                                   const PulseSegments& sparsest) noexcept;

/// Returns the energy in the capacitor at that voltage, J; 0 without a capacitor.
[[nodiscard]] double storedAt(const Plan& plan, double capacitorVoltage) noexcept;

/// Compares each quantity separately.
[[nodiscard]] TrainSums largerSums(const TrainSums& a, const TrainSums& b) noexcept;
[[nodiscard]] Run largerRun(const Run& a, const Run& b) noexcept;

/// Returns the worst run over the trains of the plan's range and every state in which a train can find the load,
/// including up to |carried| V from other trains. NaN if this is not known.
[[nodiscard]] Run worstRun(const Plan& plan, double carried) noexcept;

}  // namespace tacto::exposure
