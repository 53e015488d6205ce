// Staircase.h - the weighted staircase, an alternative to QUEST+ or a check of its result (pilot.md section 4).
//
// One move up after a wrong answer, one down after two right answers in a row. A move down is one step, a move up two;
// both are doubled until the second reversal. The run starts at the level nearest to 1.5 F and ends after 8 reversals
// or 60 trials. The estimate is the mean level of the last 6 reversals. With this ratio it approaches the level with
// √(Δ+/(Δ+ + Δ−)) = 81.6 % right answers (García-Pérez, Vision Research 38, 1998); equal steps would give 70.7 %. A
// step is one device step or 5 % of F (rounded down to the grid), whichever is more.
//
// The same settings, seed and answers give the same trials.
#pragma once

#include <optional>
#include <vector>

#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/analysis/psychophysics/TwoIntervalTrials.h"

namespace tacto {

struct StaircaseSettings {
    double felt = 0;                   ///< F, the first felt level of the ascending limits, in the grid's unit
    std::size_t reversals = 8;         ///< number of reversals that ends the run; ≥ 2
    std::size_t averaged = 6;          ///< number of last reversals in the mean; 1 to `reversals`
    std::size_t most = 60;             ///< largest number of trials; ≥ 1
    std::string stream = "staircase";  ///< name of the random order of intervals
};

struct StaircaseResult {
    /// Mean of the last reversals, in the grid's unit; NaN with fewer than `averaged`. There is no interval, because
    /// the reversals of one staircase depend on each other.
    double estimate = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> reversals;  ///< levels of the reversals
    IntervalShares intervals;
    std::vector<AnsweredTwoIntervalTrial> trials;
};

class Staircase {
public:
    /// Errors: InvalidArgument naming the setting, its value and what is accepted.
    [[nodiscard]] static Result<Staircase> create(const LevelGrid& grid, const StaircaseSettings& settings,
                                                  std::uint64_t seed);
    /// Returns the next trial, unchanged until it is answered; nothing if done().
    [[nodiscard]] std::optional<TwoIntervalTrial> next() const;
    /// Errors: InvalidArgument for a value that is not an interval, or if done(); the state then stays unchanged.
    [[nodiscard]] Result<void> answer(TrialInterval said);
    [[nodiscard]] bool done() const noexcept;
    [[nodiscard]] StaircaseResult result() const;

private:
    Staircase(const LevelGrid& grid, const StaircaseSettings& settings, std::uint64_t seed);
    void move(bool up);

    LevelGrid grid_;
    StaircaseSettings settings_;
    TwoIntervalOrder order_;
    std::size_t step_;   // in grid steps
    std::size_t index_;  // level of the open trial
    std::size_t rightInARow_ = 0;
    std::optional<bool> wentUp_;  // direction of the last move
    std::vector<double> reversals_;
    IntervalShares shares_;
    std::vector<AnsweredTwoIntervalTrial> trials_;
};

}  // namespace tacto
