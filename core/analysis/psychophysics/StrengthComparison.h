// StrengthComparison.h - a person's own Weber fraction of strength, by trials of two intervals with a train in each,
// one weaker and one stronger: "in which was it stronger? guess" (pilot.md section 8).
//
// Model: p = 0.5 + 0.48 erf(ln(b/a) / (2 ln(1 + w))) for the levels a < b: what is felt of each is ln(level)/ln(1 + w)
// JND with normal noise of 1 JND (VariationObserver.h), guess and lapse as in detection (TwoIntervalTrials.h).
// Pairs: one for each distance in steps of the grid, as near as it can be to the middle of the range, √(low · high);
// both lie within the range. Grid: ln w from ln 0.01 to ln 1 by 0.05; prior normal on ln w about ln 0.10, which has no
// source, with a standard deviation of ln 2 (choice). Next is the pair with the least expected entropy (the nearer of
// those within kEqualEntropy); the first trial and every 8th has the widest. The estimate is exp of the posterior mean
// of ln w, its interval the posterior's 2.5 and 97.5 %.
//
// The same settings, seed and answers give the same trials.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/analysis/psychophysics/TwoIntervalTrials.h"
#include "core/analysis/statistics/Estimate.h"

namespace tacto {

struct StrengthComparisonSettings {
    double low = 0;  ///< the range of the levels that are compared, in the grid's unit; at least one step wide
    double high = 0;
    std::size_t trials = 40;  ///< 1 to 1000
};

struct StrengthPair {
    double weaker = 0, stronger = 0;  ///< in the grid's unit
};

struct ComparisonTrial {
    std::size_t number = 0;  ///< from 1
    StrengthPair pair;
    TrialInterval interval = TrialInterval::First;  ///< the interval that holds the stronger
};

struct AnsweredComparison {
    StrengthPair pair;
    bool correct = false;
};

struct StrengthComparisonResult {
    Estimate weber;       ///< with its 95 % interval
    bool atEdge = false;  ///< the estimate may lie beyond 0.01 to 1, and the interval is too narrow
    IntervalShares intervals;
    std::vector<AnsweredComparison> trials;
};

class StrengthComparison {
public:
    /// Errors: InvalidArgument naming the setting, its value and what is accepted.
    [[nodiscard]] static Result<StrengthComparison> create(const LevelGrid& grid,
                                                           const StrengthComparisonSettings& settings,
                                                           std::uint64_t seed);

    /// The same trial until it is answered; nothing after the last.
    [[nodiscard]] std::optional<ComparisonTrial> next() const;
    /// Errors: InvalidArgument for a value that is not an interval, or after the last; nothing has changed then.
    [[nodiscard]] Result<void> answer(TrialInterval said);
    [[nodiscard]] StrengthComparisonResult result() const;
    [[nodiscard]] const std::vector<StrengthPair>& pairs() const noexcept { return pairs_; }

    /// Probability of a right answer by the model; `weber` > 0.
    [[nodiscard]] static double probabilityRight(const StrengthPair& pair, double weber) noexcept;

private:
    StrengthComparison(std::vector<StrengthPair> pairs, std::size_t trials, std::uint64_t seed);
    [[nodiscard]] TwoIntervalPosterior begun() const;
    void choose();

    std::vector<StrengthPair> pairs_;  // the nearest first
    std::size_t trials_;
    TwoIntervalOrder order_;
    TwoIntervalPosterior posterior_;
    std::size_t chosen_ = 0;
    IntervalShares shares_;
    std::vector<AnsweredComparison> answered_;
};

}  // namespace tacto
