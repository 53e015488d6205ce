// Transitions.h - computes how large the steps between trains feel, over the whole R–P plane.
//
// Distances are in just-noticeable differences: |ln(x1/x2)| / ln(1 + w), with the Weber fraction w (science.md section
// 10). At most 2 per train are wanted.
#pragma once

#include <algorithm>
#include <vector>

#include "core/encoding/Encoder.h"

namespace tacto {

/// Largest wanted step from one train to the next, in just-noticeable differences.
inline constexpr double kWantedPerTrain = 2;

/// Distance between two positive amplitudes, in just-noticeable differences.
[[nodiscard]] double amplitudeDistance(Volts a, Volts b) noexcept;
[[nodiscard]] double intervalDistance(Seconds a, Seconds b) noexcept;

struct TransitionSweep {
    int lines = 11;       ///< number of lines along R and along P, evenly spaced, including the ends; ≥ 2
    Seconds traverse{5};  ///< time from one end of the plane to the other, and again for the way back; > 0
};

/// The part of the plane that a finger covered between two trains, including both ends.
struct PlaneExtent {
    double lowR = 0, highR = 0;
    double lowP = 0, highP = 0;
};

/// A step from one train to the next.
struct TransitionStep {
    double R = 0;  ///< at the later train, as is P
    double P = 0;
    PlaneExtent way;  ///< part covered since the earlier train
    Command from;     ///< as delivered, with the interval that actually passed
    Command to;
    double amplitude = 0;  ///< distance in just-noticeable differences, as is `interval`
    double interval = 0;
};

/// The largest steps found, separately for amplitude and interval.
struct LargestSteps {
    TransitionStep amplitude;
    TransitionStep interval;
    /// The larger of the two distances, in just-noticeable differences.
    [[nodiscard]] double largest() const noexcept { return std::max(amplitude.amplitude, interval.interval); }
};

struct TransitionReport {
    std::vector<TransitionStep> steps;  ///< all steps of the gradual sweep, in order
    LargestSteps gradual;               ///< the largest of `steps`
    LargestSteps abrupt;                ///< after a jump of R and P between any two corners of the plane
};

/// Moves along every line of the plane and back while the scheduler sends trains (including early trains and slew
/// limits), then jumps between the corners. Errors: InvalidArgument for an invalid sweep or profile.
[[nodiscard]] Result<TransitionReport> sweepTransitions(const EncodingProfile& profile,
                                                        const TransitionSweep& sweep = {});

// A map of a sweep's steps over the R–P plane: for each cell the largest step that a finger feels on its way through
// the cell.

/// Just-noticeable differences, [P][R], lowest first; NaN in cells without any step. The centre of cell i is at i / (n
/// − 1), ends included.
struct TransitionMap {
    std::vector<std::vector<double>> amplitude;
    std::vector<std::vector<double>> interval;
};

/// A step is entered in every cell on its way. Errors: InvalidArgument unless `cells` is 2 to 101.
[[nodiscard]] Result<TransitionMap> mapOf(const std::vector<TransitionStep>& steps, int cells = 11);

}  // namespace tacto
