// ExposureRun.h - internal: one train through a load, from each state in which it may find it, as sums.
//
// Thread-safety: pure functions; nothing allocates.
#pragma once

#include <array>
#include <cmath>

#include "core/electrode/LoadResponse.h"
#include "core/safety/TrainExposure.h"

namespace tacto::exposure {

/// The larger of both; NaN wins, so that it is refused and not lost.
[[nodiscard]] inline double larger(double a, double b) noexcept { return std::isnan(a) || a > b ? a : b; }

/// Sums over a stretch of time of what is nowhere below 0.
struct Sums {
    double squares = 0;     // ∫i², A²s
    double volts = 0;       // ∫v², V²s
    double dissipated = 0;  // energy less what the capacitor kept, J
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

/// The sums over one run of a train, starting with some voltage on the load's capacitor.
struct Run {
    double peakVoltage = 0, peakCurrent = 0, phaseCharge = 0;  // Largest of any pulse
    double netCharge = 0, energy = 0;                          // Largest of any pulse, its rest included
    // A stretch of n periods holds at most n times `pulse`, part by part the most of any pulse, and `cut`: it may begin
    // in a part of one pulse and end in the same part of another.
    Sums pulse, cut;
    Sums cutTrain;             // the same as `cut` for whole trains, which may find the load differently
    TrainSums inDuration;      // the sums over n / rate
    TrainSums whole;           // the sums with the rest until the next train
    double endOfTrain = 0;     // Capacitor voltage after n / rate, V
    double endOfInterval = 0;  // when the next train begins
};

/// Everything about a run but its start: constant while one exposure is computed.
struct Plan {
    Circuit circuit;
    PulseSegments pulse;
    DriveSegment betweenPulses;
    std::array<double, 3> leastPulse_s{};  // each segment of the sparsest train in the range
    double mostBetweenPulses_s = 0;        // the longest rest between its pulses
    DriveSegment afterTrain;
    double leastAfterTrain_s = 0;  // rest after the sparsest train of the range, which has the longest pulses
    int pulses = 1;
    SourceLimits limits;  // Infinite: what clipping takes away is counted as delivered
};

/// How long each segment of `densest` lasts in the sparsest train, which may lack its gap; in s.
[[nodiscard]] std::array<double, 3> leastDurations(const PulseSegments& densest,
                                                   const PulseSegments& sparsest) noexcept;

/// The energy in the capacitor at that voltage, J; 0 without one.
[[nodiscard]] double storedAt(const Plan& plan, double capacitorVoltage) noexcept;

/// Quantity by quantity.
[[nodiscard]] TrainSums largerSums(const TrainSums& a, const TrainSums& b) noexcept;
[[nodiscard]] Run largerRun(const Run& a, const Run& b) noexcept;

/// Worst over every state in which a train can find the load, up to |carried| V from others included, and over the
/// trains of the plan's range. NaN where that is not known.
[[nodiscard]] Run worstRun(const Plan& plan, double carried) noexcept;

}  // namespace tacto::exposure
