// VariationObserver.h - an observer who names what was felt: signal detection in two dimensions.
//
// A stimulus is a point, amplitude and interval in just-noticeable differences of this observer. What is felt is the
// point plus independent normal noise in either dimension; the answer is the nearest of the points learned (of equal
// ones the first). An amplitude that is felt below the detection threshold is answered "none", or guessed. In a share
// of trials, lapses, any of the names is given with equal probability. Criteria that drift, memory noise that grows
// with the range of stimuli and learning are left out: real people do worse.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "core/analysis/variation/VirtualParticipant.h"

namespace tacto {

/// The answer of a participant who felt nothing.
enum class GuessBehaviour {
    None,     ///< "none": a column of its own, counted as wrong
    Uniform,  ///< any of the names, as in a forced choice
};
[[nodiscard]] std::string_view nameOf(GuessBehaviour guess) noexcept;  // "none", "uniform"
[[nodiscard]] Result<GuessBehaviour> guessBehaviourFrom(std::string_view name);

/// ln(amplitude) / ln(1 + w) and ln(interval) / ln(1 + w).
struct FeltPoint {
    double amplitude_jnd = 0;
    double interval_jnd = 0;
};
/// Euclidean: the d' of two conditions for an observer whose noise is 1.
[[nodiscard]] double distance_jnd(const FeltPoint& a, const FeltPoint& b) noexcept;

/// What `who` feels when a train of `level` (a current, or an intensity) comes every `interval`.
[[nodiscard]] FeltPoint feltBy(const VirtualParticipant& who, double level, Seconds interval) noexcept;

struct Observer {
    double noise_jnd = 1;  ///< > 0, both dimensions
    double lapse = 0;      ///< 0 to 1
    /// In just-noticeable differences of amplitude; minus infinity: everything is felt.
    double detection_jnd = -std::numeric_limits<double>::infinity();
    GuessBehaviour guess = GuessBehaviour::None;
};

/// `who` as an observer whose detection threshold is `detection`, in the levels' unit.
[[nodiscard]] Observer observerOf(const VirtualParticipant& who, double detection,
                                  GuessBehaviour guess = GuessBehaviour::None) noexcept;

/// A condition that is never given keeps its row and column, so that indices match the experiment.
struct IdentificationTask {
    std::vector<FeltPoint> points;  ///< one for every condition
    std::vector<bool> given;        ///< as many as `points`: presented, and learned as an answer
};

/// [stimulus][response], the last response being "none"; rows of conditions that are not given are 0. To about 1e-10,
/// by quadrature over the regions nearest to each point.
[[nodiscard]] std::vector<std::vector<double>> responseProbabilities(const IdentificationTask& task,
                                                                     const Observer& observer);

/// One answer to a stimulus, which need not be one of the points (nothing at all is an amplitude of minus infinity):
/// the index of a point, or points.size() for "none".
[[nodiscard]] std::size_t sampleResponse(const IdentificationTask& task, const Observer& observer,
                                         const FeltPoint& stimulus, Random& random);

/// `trials` presentations of each given condition. The same shape as responseProbabilities(), in counts.
[[nodiscard]] std::vector<std::vector<std::size_t>> sampleResponses(const IdentificationTask& task,
                                                                    const Observer& observer, std::size_t trials,
                                                                    Random& random);

}  // namespace tacto
