// QuestPlus.h - QUEST+ for detection: the level with the least expected entropy is asked next (pilot.md section 4).
//
// Model (Watson, Journal of Vision 17(3):10, 2017): p(x) = 0.5 + 0.48 (1 − exp(−10^(β (x − α)/20))), x in dB re 1 mA
// (of an intensity: re 1). The lapse rate is fixed at 0.02 (TwoIntervalTrials.h).
// Grid: α = 20 lg F − 12 … + 9 dB by 0.5, β in {2, 4, 8, 16}; prior normal on α, even on β. Levels are those of the
// LevelGrid above 0. Next is the level whose expected posterior entropy is least (the weakest of those within
// kEqualEntropy), but no level four times in a row as long as there is another. The first trial and every 8th (8, 16,
// 24 ...) is easy: the level nearest to 1.5 times the estimate. The estimate is the posterior mean of α, where 80 % of
// the answers are right; its interval is the posterior's 2.5 and 97.5 %, each cell of the α grid taken as even.
//
// The same settings, seed and answers give the same trials. A trial takes about 0.1 ms on 30 levels.
#pragma once

#include <optional>
#include <vector>

#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/analysis/psychophysics/TwoIntervalTrials.h"
#include "core/analysis/statistics/Estimate.h"

namespace tacto {

struct QuestPlusSettings {
    double felt = 0;                   ///< F, in the grid's unit: the centre of the α grid and the first estimate
    double prior = 0;                  ///< median of the prior on α, in the grid's unit; 0: F − 1 dB
    double priorSd_db = 4;             ///< > 0
    double first = 0;                  ///< the first trial is nearest to 1.5 times this; 0: F
    std::size_t least = 24;            ///< trials before the precision ends it; ≥ 1
    std::size_t most = 40;             ///< trials; ≥ least
    double enough_db = 0.8;            ///< posterior standard deviation at which it ends; 0: only `most` does
    std::string stream = "detection";  ///< name of the order of intervals
};

struct QuestPlusResult {
    Estimate estimate;  ///< estimate of α with its 95 % interval, in the grid's unit
    double sd_db = std::numeric_limits<double>::quiet_NaN();
    double slope = std::numeric_limits<double>::quiet_NaN();  ///< posterior mean of β
    /// More than 2.5 % of the posterior lies at an end of the α grid: the threshold may lie beyond, and the interval is
    /// too narrow.
    bool atEdge = false;
    IntervalShares intervals;
    std::vector<AnsweredTwoIntervalTrial> trials;
};

class QuestPlus {
public:
    /// Errors: InvalidArgument naming the setting, its value and what is accepted.
    [[nodiscard]] static Result<QuestPlus> create(const LevelGrid& grid, const QuestPlusSettings& settings,
                                                  std::uint64_t seed);

    /// The same trial until it is answered; nothing when done().
    [[nodiscard]] std::optional<TwoIntervalTrial> next() const;
    /// Errors: InvalidArgument for a value that is not an interval, or when done(); nothing has changed then.
    [[nodiscard]] Result<void> answer(TrialInterval said);
    [[nodiscard]] bool done() const;
    /// The estimate from the answers so far; without any, from the prior.
    [[nodiscard]] QuestPlusResult result() const;
    /// Posterior probability that α lies above `level` (> 0, in the grid's unit).
    [[nodiscard]] double probabilityAbove(double level) const;

    /// Probability of a right answer by the model.
    [[nodiscard]] static double probabilityRight(double level_db, double alpha_db, double slope) noexcept;

private:
    QuestPlus(const LevelGrid& grid, const QuestPlusSettings& settings, std::uint64_t seed);
    void choose();
    [[nodiscard]] TwoIntervalPosterior begun() const;
    [[nodiscard]] EvenDensity ofAlpha() const;

    LevelGrid grid_;
    QuestPlusSettings settings_;
    TwoIntervalOrder order_;
    TwoIntervalPosterior posterior_;  // its choices are the levels above 0, its cells α · slopes + β
    std::size_t chosen_ = 1;          // index of a level
    IntervalShares shares_;
    std::vector<AnsweredTwoIntervalTrial> trials_;
};

// Is the lowest condition still felt? Asked before each later block (pilot.md section 4).
//
// 12 QUEST+ trials with the last estimate as prior (2.5 dB). When P(1.1 α > I_min) ≥ 0.8 the participant rests 5 min
// and is checked again, three times at most, each time with the newest estimate as prior; when that does not help the
// block is adapted, which marks it and ends nothing. The range never changes within a session.
//
// The same settings, seed and answers give the same trials.

struct DriftCheckSettings {
    double felt = 0;        ///< F of the session's ascending limits, in the grid's unit: the centre of the α grid
    double last = 0;        ///< last estimate of α; > 0
    double min = 0;         ///< I_min; > 0
    std::size_t block = 0;  ///< the block that follows; it names the order of intervals
    double priorSd_db = 2.5;
    std::size_t trials = 12;
    double margin = 1.1;
    double threshold = 0.8;
    std::size_t rests = 3;  ///< at most
};

enum class DriftStep { Trial, Rest, Done };

struct DriftResult {
    Estimate estimate;                                              ///< from the last check, in the grid's unit
    double probability = std::numeric_limits<double>::quiet_NaN();  ///< P(margin α > I_min) of the last check
    std::size_t rests = 0;
    bool adapted = false;                 ///< still so after the last rest
    std::vector<QuestPlusResult> checks;  ///< each that was completed
};

class DriftCheck {
public:
    /// Errors: InvalidArgument naming the setting, its value and what is accepted.
    [[nodiscard]] static Result<DriftCheck> create(const LevelGrid& grid, const DriftCheckSettings& settings,
                                                   std::uint64_t seed);

    [[nodiscard]] DriftStep step() const noexcept { return step_; }
    /// Nothing unless step() is Trial.
    [[nodiscard]] std::optional<TwoIntervalTrial> next() const;
    /// Errors: InvalidArgument for a value that is not an interval, or when no trial is asked for.
    [[nodiscard]] Result<void> answer(TrialInterval said);
    /// The rest is over. Errors: InvalidArgument when none was asked for.
    [[nodiscard]] Result<void> rested();
    [[nodiscard]] bool done() const noexcept { return step_ == DriftStep::Done; }
    [[nodiscard]] const DriftResult& result() const noexcept { return result_; }

private:
    DriftCheck(const LevelGrid& grid, const DriftCheckSettings& settings, std::uint64_t seed, QuestPlus quest);
    [[nodiscard]] static Result<QuestPlus> checkFor(const LevelGrid& grid, const DriftCheckSettings& settings,
                                                    std::uint64_t seed, double prior, std::size_t rests);

    LevelGrid grid_;
    DriftCheckSettings settings_;
    std::uint64_t seed_;
    QuestPlus quest_;
    DriftStep step_ = DriftStep::Trial;
    DriftResult result_;
};

}  // namespace tacto
