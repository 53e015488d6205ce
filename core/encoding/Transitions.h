// Transitions.h - how large a step from one train to the next feels, over the whole R–P plane.
//
// Distances are in just-noticeable differences: |ln(x1/x2)| / ln(1 + w), w the Weber fraction (science.md section 10).
// At most 2 per train is wanted.
#pragma once

#include <algorithm>
#include <vector>

#include "core/encoding/Encoder.h"

namespace tacto {

/// Just-noticeable differences from a train to the next, at most: what is wanted.
inline constexpr double kWantedPerTrain = 2;

/// The distance of two amplitudes that are both above 0.
[[nodiscard]] double amplitudeDistance(Volts a, Volts b) noexcept;
[[nodiscard]] double intervalDistance(Seconds a, Seconds b) noexcept;

struct TransitionSweep {
    int lines = 11;       ///< lines along R and along P, evenly spaced, ends included; ≥ 2
    Seconds traverse{5};  ///< time from one end of the plane to the other, and the same back; > 0
};

/// The stretch that a finger covered between two trains, with both its ends.
struct PlaneExtent {
    double lowR = 0, highR = 0;
    double lowP = 0, highP = 0;
};

/// A step from one train to the next.
struct TransitionStep {
    double R = 0;  ///< at the later train
    double P = 0;
    PlaneExtent way;  ///< how far it moved since the earlier train
    Command from;     ///< as delivered, with the interval that passed
    Command to;
    double amplitude = 0;  ///< just-noticeable differences
    double interval = 0;
};

/// The worst steps found, each axis for itself.
struct LargestSteps {
    TransitionStep amplitude;
    TransitionStep interval;
    /// Just-noticeable differences, the worse axis.
    [[nodiscard]] double largest() const noexcept { return std::max(amplitude.amplitude, interval.interval); }
};

struct TransitionReport {
    std::vector<TransitionStep> steps;  ///< the steps of the gradual sweep, in order
    LargestSteps gradual;               ///< the largest of `steps`
    LargestSteps abrupt;                ///< when R and P jump between any two corners of the plane
};

/// Moves along every line of the plane and back while trains go out as the scheduler has them (pulled forward, slew
/// limits and all), then jumps between the corners. Errors: InvalidArgument for a sweep or profile that is not valid.
[[nodiscard]] Result<TransitionReport> sweepTransitions(const EncodingProfile& profile,
                                                        const TransitionSweep& sweep = {});

// The steps of a sweep laid over the R–P plane: in each cell the largest step that a finger feels on
// its way through it.

/// Just-noticeable differences, [P][R], lowest first; NaN where no step leads through the cell. Cell i is centred on
/// i / (n − 1), the ends included.
struct TransitionMap {
    std::vector<std::vector<double>> amplitude;
    std::vector<std::vector<double>> interval;
};

/// A step counts in every cell that its way leads through. Errors: InvalidArgument unless `cells` is 2 to 101.
[[nodiscard]] Result<TransitionMap> mapOf(const std::vector<TransitionStep>& steps, int cells = 11);

}  // namespace tacto
