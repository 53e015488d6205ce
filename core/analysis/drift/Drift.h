// Drift.h - did the amplitude stay where it was over the trials of a session? science.md section 10.
//
// Works on measured trials, never on commands. A trial that was not measured can make the verdict indeterminate, never
// a pass (hazard H9). The channel's gain is the same in all trials and divides out; the instrument's other uncertainty
// is the least scatter that is taken.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/analysis/separability/Separability.h"
#include "core/base/JustNoticeable.h"
#include "core/results/ResultKind.h"

namespace tacto {

struct DriftOptions {
    /// The largest change that is accepted, in % of the amplitude; above 0, at most 100. Half of what people notice.
    double tolerance_pct = 50 * kAmplitudeWeberFraction;
};

struct Drift {
    struct Condition {
        std::string name;
        std::size_t n = 0;  ///< measured trials
        std::size_t notMeasured = 0;
        Statistics amplitude = {};
        Estimate change_pct = {};         ///< from the first trial of the session to its last; NaN for fewer than three
        std::vector<double> trial = {};   ///< numbers of the measured trials within the session, from 1
        std::vector<double> change = {};  ///< how far each is from the condition's mean, in %
    };
    /// A quarter of the session's trials, in their order.
    struct Quarter {
        std::size_t from = 0, to = 0;  ///< numbers of its first and its last trial
        std::size_t n = 0;             ///< measured trials
        double change_pct = 0;         ///< from the mean of the four; NaN where the conditions could explain it
    };
    std::size_t trials = 0;
    std::vector<Condition> conditions;
    std::vector<Quarter> quarters;
    /// The part that all conditions share: a straight line over the whole session, first trial to last.
    Estimate change_pct;
    /// The largest difference of two quarters, which a warm-up or a step makes and a straight line hides. The interval
    /// holds for the largest of the six (Bonferroni).
    Estimate betweenQuarters_pct;
    double floor_pct = 0;  ///< standard deviation below which no scatter is taken; NaN: unknown
    double tolerance_pct = 0;
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons;
};

/// Least squares on the logarithm of the amplitude, with a level for each condition (analysis of covariance); intervals
/// are 95 %, by Student's t. A pass has both intervals within the tolerance; a fail has one of them beyond it.
/// Errors: InvalidArgument for no trials, one without a condition, a measured amplitude that is not above zero and
/// finite, and a tolerance out of its range.
[[nodiscard]] Result<Drift> judgeDrift(std::span<const SeparabilityTrial> trials, const DriftOptions& options = {});

/// The drift as the command line's contract has it (cli.md); `curves` is the figure, for plot.curves().
[[nodiscard]] nlohmann::json toJson(const Drift& found);
/// How it is judged and shown.
[[nodiscard]] ResultTraits driftKind();

}  // namespace tacto
