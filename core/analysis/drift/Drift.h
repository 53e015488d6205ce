// Drift.h - tests whether the amplitude stayed constant over the trials of a session (science.md section 10).
//
// Uses measured trials, never commands. An unmeasured trial can make the verdict indeterminate, but never a pass
// (hazard H9). The channel's gain is equal in all trials and cancels; the instrument's other uncertainty is the lower
// bound of the scatter.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/analysis/separability/Separability.h"
#include "core/base/JustNoticeable.h"
#include "core/results/ResultKind.h"

namespace tacto {

struct DriftOptions {
    /// Largest accepted change in % of the amplitude; above 0, at most 100. Default: half of what people notice.
    double tolerance_pct = 50 * kAmplitudeWeberFraction;
};

struct Drift {
    struct Condition {
        std::string name;
        std::size_t n = 0;  ///< number of measured trials
        std::size_t notMeasured = 0;
        Statistics amplitude = {};
        Estimate change_pct = {};         ///< from the first trial of the session to the last; NaN for fewer than three
        std::vector<double> trial = {};   ///< numbers of the measured trials in the session, from 1
        std::vector<double> change = {};  ///< deviation of each trial from the condition's mean, in %
    };
    /// One quarter of the session's trials, in their order.
    struct Quarter {
        std::size_t from = 0, to = 0;  ///< numbers of the first and last trial
        std::size_t n = 0;             ///< number of measured trials
        double change_pct = 0;         ///< from the mean of all four; NaN if the conditions could explain the change
    };
    std::size_t trials = 0;
    std::vector<Condition> conditions;
    std::vector<Quarter> quarters;
    /// Change common to all conditions: a straight line over the whole session, from the first trial to the last.
    Estimate change_pct;
    /// Largest difference between two quarters. It shows a warm-up or a step, which a straight line hides. The interval
    /// is valid for the largest of the six differences (Bonferroni).
    Estimate betweenQuarters_pct;
    double floor_pct = 0;  ///< lower bound of the standard deviation; NaN: unknown
    double tolerance_pct = 0;
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons;
};

/// Fits the logarithm of the amplitude by least squares, with a level for each condition (analysis of covariance); 95 %
/// intervals by Student's t. Passes if both intervals lie within the tolerance, fails if one lies beyond it. Errors:
/// InvalidArgument for no trials, a trial without a condition, a measured amplitude that is not positive and finite,
/// and a tolerance out of range.
[[nodiscard]] Result<Drift> judgeDrift(std::span<const SeparabilityTrial> trials, const DriftOptions& options = {});

/// Writes the drift as JSON in the command-line contract (cli.md); `curves` is the figure for plot.curves().
[[nodiscard]] nlohmann::json toJson(const Drift& found);
/// Describes how a drift is judged and shown.
[[nodiscard]] ResultTraits driftKind();

}  // namespace tacto
