// Staircase.h - the weighted staircase, instead of QUEST+ or as a check on it (pilot.md section 4).
//
// One up after a wrong answer, one down after two right ones in a row; down by one step and up by two, both doubled
// until the second reversal. It starts at the level nearest to 1.5 F and ends after 8 reversals or 60 trials; the
// estimate is the mean of the levels of the last 6 reversals. With steps of this ratio it approaches the level with
// √(Δ+/(Δ+ + Δ−)) = 81.6 % right answers (García-Pérez, Vision Research 38, 1998); with equal steps it would be 70.7 %.
// A step is one device step, or 5 % of F (rounded down to the grid) where that is more.
//
// The same settings, seed and answers give the same trials.
#pragma once

#include <optional>
#include <vector>

#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/analysis/psychophysics/TwoIntervalTrials.h"

namespace tacto {

struct StaircaseSettings {
    double felt = 0;                   ///< F, in the grid's unit
    std::size_t reversals = 8;         ///< how many reversals end it; ≥ 2
    std::size_t averaged = 6;          ///< how many of the last reversals are averaged; 1 to `reversals`
    std::size_t most = 60;             ///< trials; ≥ 1
    std::string stream = "staircase";  ///< name of the order of intervals
};

struct StaircaseResult {
    /// Mean of the last reversals, in the grid's unit; NaN with fewer than `averaged` of them. Without an interval:
    /// reversals of one staircase depend on each other.
    double estimate = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> reversals;  ///< levels
    IntervalShares intervals;
    std::vector<AnsweredTwoIntervalTrial> trials;
};

class Staircase {
public:
    /// Errors: InvalidArgument naming the setting, its value and what is accepted.
    [[nodiscard]] static Result<Staircase> create(const LevelGrid& grid, const StaircaseSettings& settings,
                                                  std::uint64_t seed);
    /// The same trial until it is answered; nothing when done().
    [[nodiscard]] std::optional<TwoIntervalTrial> next() const;
    /// Errors: InvalidArgument for a value that is not an interval, or when done(); nothing has changed then.
    [[nodiscard]] Result<void> answer(TrialInterval said);
    [[nodiscard]] bool done() const noexcept;
    [[nodiscard]] StaircaseResult result() const;

private:
    Staircase(const LevelGrid& grid, const StaircaseSettings& settings, std::uint64_t seed);
    void move(bool up);

    LevelGrid grid_;
    StaircaseSettings settings_;
    TwoIntervalOrder order_;
    std::size_t step_;   // Grid steps
    std::size_t index_;  // Level of the trial that is asked for
    std::size_t rightInARow_ = 0;
    std::optional<bool> wentUp_;  // Direction of the last move
    std::vector<double> reversals_;
    IntervalShares shares_;
    std::vector<AnsweredTwoIntervalTrial> trials_;
};

}  // namespace tacto
