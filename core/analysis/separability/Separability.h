// Separability.h - can the conditions be told apart from what was measured? science.md section 10.
//
// Works on measured trials, never on commands. A trial that was not measured can make the verdict indeterminate, never
// a pass (hazard H9).
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

/// One presentation of a condition, as measured. Amplitude in V or mA, the same for all; NaN = not measured.
/// Standard uncertainties (k = 1) in the same units. NaN = unknown, which forbids a pass; 0 = the trials come without
/// (a table of numbers), and 0.1 % of the mean over all trials stands in for it.
struct SeparabilityTrial {
    std::string condition;
    double amplitude = 0;
    double interval_s = 0;
    double amplitudeUncertainty = 0;
    double intervalUncertainty_s = 0;  ///< uncertainty of the reading: sampling and noise
    double timeBase = 0;  ///< relative, of the oscilloscope's time base; NaN = unknown, 0 = exact or not stated
    /// Relative: the part of amplitudeUncertainty that the channel's gain makes, the same in all trials. NaN or 0: not
    /// known to be.
    double amplitudeGain = 0;
};

struct SeparabilityOptions {
    /// Conditions that must be there, in the order of the confusion matrix. Empty: the conditions met, with the paper's
    /// four in their own order (smooth-low, smooth-high, rough-low, rough-high), others as first met.
    std::vector<std::string> conditions;
};

struct ConditionSummary {
    std::string name;
    std::size_t n = 0;  ///< measured trials
    std::size_t notMeasured = 0;
    Statistics amplitude;
    Statistics interval_s;
    double amplitudeVariation = std::numeric_limits<double>::quiet_NaN();  ///< coefficient of variation, sd/mean
    double intervalVariation = std::numeric_limits<double>::quiet_NaN();
    Bounds amplitudeVariationBounds;  ///< the judged bounds
    Bounds intervalVariationBounds;
};

struct PairSummary {
    std::string a;
    std::string b;
    double mahalanobis = 0;   ///< distance, not its square; NaN when a condition has no measured trial, or the
                              ///< instrument's uncertainty is unknown
    double amplitudeJnd = 0;  ///< just-noticeable differences between the means
    double intervalJnd = 0;
    Bounds amplitudeJndBounds;  ///< the judged bounds, with the instrument's uncertainty, except for the gain and the
                                ///< time base, which divide out of a ratio
    Bounds intervalJndBounds;
};

struct Separability {
    std::vector<ConditionSummary> conditions;
    std::vector<PairSummary> pairs;                   ///< a before b, in the conditions' order
    std::vector<std::vector<std::size_t>> confusion;  ///< [presented][classified], cross-validated
    Estimate accuracy;                                ///< accuracy of the cross-validation, Wilson 95 %
    std::size_t folds = 0;                            ///< 0: too few trials to cross-validate
    double amplitudeFloor = 0;   ///< standard deviation below which no variance is taken: the measurement's own; NaN =
                                 ///< unknown
    double intervalFloor_s = 0;  ///< reading and time base together
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons;  ///< sentences; what decided the verdict comes first
};

/// Linear discriminant analysis with pooled covariance and equal priors (no condition is more likely than another),
/// cross-validated in min(10, smallest n) folds, trial i of a condition in fold i mod folds. Variances are floored at
/// the square of the stated uncertainty (root mean square over trials; of the interval with the time base), or of 0.1 %
/// of the mean over all trials where the trials come without.
/// Judged by one-sided 95 % bounds (science.md section 10): 5 just-noticeable differences are reached when the lower
/// bound reaches them, missed when the upper one does not, and open between; 5 % of variation likewise.
/// Errors: InvalidArgument for fewer than two conditions, an unnamed or unexpected condition, or a measured value
/// that is not above zero and finite.
[[nodiscard]] Result<Separability> judgeSeparability(std::span<const SeparabilityTrial> trials,
                                                     const SeparabilityOptions& options = {});

}  // namespace tacto
