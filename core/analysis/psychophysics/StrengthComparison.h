// StrengthComparison.h - measures a person's own Weber fraction of strength. Each trial has two intervals with one
// train each, one weaker and one stronger, and asks: "in which was it stronger? guess" (pilot.md section 8).
//
// Model: p = 0.5 + 0.48 erf(ln(b/a) / (2 ln(1 + w))) for levels a < b. Each level is felt as ln(level)/ln(1 + w) JND
// with normal noise of 1 JND (VariationObserver.h); guess and lapse rates as in detection (TwoIntervalTrials.h).
// Pairs: one for each distance in grid steps, within the range and as near as possible to its middle √(low · high).
// Grid: ln w from ln 0.01 to ln 1 by 0.05; prior normal in ln w with centre ln 0.10 (without a source) and standard
// deviation ln 2 (choice). Next comes the pair with the least expected entropy (the closest pair within kEqualEntropy).
// The first trial and every 8th use the widest pair. The estimate is exp of the posterior mean of ln w; its interval is
// the posterior's 2.5 and 97.5 % points.
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
    double low = 0;  ///< range of the compared levels, in the grid's unit; at least one step wide
    double high = 0;
    std::size_t trials = 40;  ///< 1 to 1000
};

struct StrengthPair {
    double weaker = 0, stronger = 0;  ///< in the grid's unit
};

struct ComparisonTrial {
    std::size_t number = 0;  ///< from 1
    StrengthPair pair;
    TrialInterval interval = TrialInterval::First;  ///< the interval with the stronger train
};

struct AnsweredComparison {
    StrengthPair pair;
    bool correct = false;
};

struct StrengthComparisonResult {
    Estimate weber;       ///< with its 95 % interval
    bool atEdge = false;  ///< true if w may lie outside 0.01 to 1; the interval is then too narrow
    IntervalShares intervals;
    std::vector<AnsweredComparison> trials;
};

class StrengthComparison {
public:
    /// Errors: InvalidArgument naming the setting, its value and what is accepted.
    [[nodiscard]] static Result<StrengthComparison> create(const LevelGrid& grid,
                                                           const StrengthComparisonSettings& settings,
                                                           std::uint64_t seed);

    /// Returns the next trial, unchanged until it is answered; nothing after the last trial.
    [[nodiscard]] std::optional<ComparisonTrial> next() const;
    /// Errors: InvalidArgument for a value that is not an interval, or after the last trial; nothing has changed then.
    [[nodiscard]] Result<void> answer(TrialInterval said);
    [[nodiscard]] StrengthComparisonResult result() const;
    [[nodiscard]] const std::vector<StrengthPair>& pairs() const noexcept { return pairs_; }

    /// Probability of a right answer according to the model; `weber` > 0.
    [[nodiscard]] static double probabilityRight(const StrengthPair& pair, double weber) noexcept;

private:
    StrengthComparison(std::vector<StrengthPair> pairs, std::size_t trials, std::uint64_t seed);
    [[nodiscard]] TwoIntervalPosterior begun() const;
    void choose();

    std::vector<StrengthPair> pairs_;  // in order of distance, smallest first
    std::size_t trials_;
    TwoIntervalOrder order_;
    TwoIntervalPosterior posterior_;
    std::size_t chosen_ = 0;
    IntervalShares shares_;
    std::vector<AnsweredComparison> answered_;
};

}  // namespace tacto
