// VariationObserver.h - an observer who names the condition that was felt: signal detection in two dimensions.
//
// A stimulus is a point: its amplitude and interval in just-noticeable differences of this observer. The observer feels
// the point plus independent normal noise in each dimension and answers the nearest learned point (the first of equally
// near points). An amplitude felt below the detection threshold is answered "none" or guessed. In lapse trials every
// name is equally likely. Drifting criteria, memory noise that grows with the stimulus range, and learning are not
// modelled, so real people do worse.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "core/analysis/variation/VirtualParticipant.h"

namespace tacto {

/// What a participant who felt nothing answers.
enum class GuessBehaviour {
    None,     ///< answers "none", which has its own column and is wrong
    Uniform,  ///< guesses any of the names, as in a forced choice
};
[[nodiscard]] std::string_view nameOf(GuessBehaviour guess) noexcept;  // "none", "uniform"
[[nodiscard]] Result<GuessBehaviour> guessBehaviourFrom(std::string_view name);

/// The coordinates of a stimulus: ln(amplitude) / ln(1 + w) and ln(interval) / ln(1 + w), with the Weber fraction w.
struct FeltPoint {
    double amplitude_jnd = 0;
    double interval_jnd = 0;
};
/// Euclidean distance; equals d' of two conditions for an observer with noise 1.
[[nodiscard]] double distance_jnd(const FeltPoint& a, const FeltPoint& b) noexcept;

/// The point that `who` feels when a train of `level` (a current, or an intensity) repeats every `interval`.
[[nodiscard]] FeltPoint feltBy(const VirtualParticipant& who, double level, Seconds interval) noexcept;

struct Observer {
    double noise_jnd = 1;  ///< noise in each dimension, > 0
    double lapse = 0;      ///< 0 to 1
    /// Detection threshold in just-noticeable differences of amplitude. Minus infinity: everything is felt.
    double detection_jnd = -std::numeric_limits<double>::infinity();
    GuessBehaviour guess = GuessBehaviour::None;
};

/// Makes an observer from `who`, with the detection threshold `detection` in the unit of the levels.
[[nodiscard]] Observer observerOf(const VirtualParticipant& who, double detection,
                                  GuessBehaviour guess = GuessBehaviour::None) noexcept;

/// The points and which of them are given. A condition that is never given keeps its row and column in the results.
struct IdentificationTask {
    std::vector<FeltPoint> points;  ///< one for every condition
    std::vector<bool> given;        ///< for each point: presented, and learned as an answer
};

/// Probabilities [stimulus][response]; the last response is "none". Rows of conditions that are not given are 0.
/// Accurate to about 1e-10, by quadrature over the regions of points nearest to each condition.
[[nodiscard]] std::vector<std::vector<double>> responseProbabilities(const IdentificationTask& task,
                                                                     const Observer& observer);

/// Draws one answer to any stimulus (an amplitude of minus infinity means no stimulus). Returns the index of a point,
/// or points.size() for "none".
[[nodiscard]] std::size_t sampleResponse(const IdentificationTask& task, const Observer& observer,
                                         const FeltPoint& stimulus, Random& random);

/// Draws `trials` answers to each given condition. Returns counts in the layout of responseProbabilities().
[[nodiscard]] std::vector<std::vector<std::size_t>> sampleResponses(const IdentificationTask& task,
                                                                    const Observer& observer, std::size_t trials,
                                                                    Random& random);

}  // namespace tacto
