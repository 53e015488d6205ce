// Separability.h - tests whether the measured conditions can be told apart (science.md section 10).
//
// Uses measured trials, never commands. An unmeasured trial can make the verdict indeterminate, but never a pass
// (hazard H9).
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/statistics/ConfidenceBound.h"
#include "core/analysis/statistics/Estimate.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/base/Result.h"
#include "core/base/Statistics.h"

namespace tacto {

/// One measured presentation of a condition. Amplitude in V or mA, in one unit for all trials; NaN = not measured.
/// Standard uncertainties (k = 1) have the same units. NaN = unknown, which prevents a pass; 0 = not stated (a table of
/// numbers), replaced by 0.1 % of the mean over all trials.
struct SeparabilityTrial {
    std::string condition;
    double amplitude = 0;
    double interval_s = 0;
    double amplitudeUncertainty = 0;
    double intervalUncertainty_s = 0;  ///< from sampling and noise of the reading
    double timeBase = 0;  ///< relative, of the oscilloscope's time base; NaN = unknown, 0 = exact or not stated
    /// Relative: the part of amplitudeUncertainty caused by the channel's gain, equal in all trials. NaN or 0: no such
    /// part is known.
    double amplitudeGain = 0;
};

struct SeparabilityOptions {
    /// Required conditions, in the order of the confusion matrix. If empty: the conditions found, first the paper's
    /// four (smooth-low, smooth-high, rough-low, rough-high), then others in the order of appearance.
    std::vector<std::string> conditions;
};

struct ConditionSummary {
    std::string name;
    std::size_t n = 0;  ///< number of measured trials
    std::size_t notMeasured = 0;
    Statistics amplitude;
    Statistics interval_s;
    double amplitudeVariation = std::numeric_limits<double>::quiet_NaN();  ///< coefficient of variation, sd/mean
    double intervalVariation = std::numeric_limits<double>::quiet_NaN();
    Bounds amplitudeVariationBounds;  ///< one-sided 95 % bounds, used for the verdict
    Bounds intervalVariationBounds;
};

struct PairSummary {
    std::string a;
    std::string b;
    double mahalanobis = 0;   ///< distance, not its square; NaN if a condition has no measured trial or the
                              ///< instrument's uncertainty is unknown
    double amplitudeJnd = 0;  ///< just-noticeable differences between the means
    double intervalJnd = 0;
    Bounds amplitudeJndBounds;  ///< bounds used for the verdict, with the instrument's uncertainty except for gain and
                                ///< time base, which cancel in a ratio
    Bounds intervalJndBounds;
};

struct Separability {
    std::vector<ConditionSummary> conditions;
    std::vector<PairSummary> pairs;                   ///< index of a below index of b
    std::vector<std::vector<std::size_t>> confusion;  ///< [presented][classified], cross-validated
    Estimate accuracy;                                ///< of the cross-validation, Wilson 95 %
    std::size_t folds = 0;                            ///< 0: too few trials to cross-validate
    double amplitudeFloor = 0;   ///< lower bound of the standard deviation, from the measurement's own uncertainty;
                                 ///< unknown: NaN
    double intervalFloor_s = 0;  ///< from the reading and the time base
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons;  ///< sentences; the deciding reasons come first
};

/// Applies linear discriminant analysis with pooled covariance and equal priors (all conditions equally likely),
/// cross-validated in min(10, smallest n) folds; trial i of a condition is in fold i mod folds. No variance is less
/// than the square of the stated uncertainty (root mean square over trials; for the interval including the time base),
/// or of 0.1 % of the mean over all trials if none is stated. The verdict uses one-sided 95 % bounds (science.md
/// section 10): passed if the lower bound reaches 5 just-noticeable differences, failed if the upper bound does not,
/// otherwise open; likewise for 5 % of variation. Errors: InvalidArgument for fewer than two conditions, an unnamed or
/// unexpected condition, or a measured value that is not positive and finite.
[[nodiscard]] Result<Separability> judgeSeparability(std::span<const SeparabilityTrial> trials,
                                                     const SeparabilityOptions& options = {});

}  // namespace tacto
