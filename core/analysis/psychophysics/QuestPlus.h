// QuestPlus.h - QUEST+ for detection: the level with the least expected entropy is asked next (pilot.md section 4).
//
// Model (Watson, Journal of Vision 17(3):10, 2017): p(x) = 0.5 + 0.48 (1 − exp(−10^(β (x − α)/20))), x in dB re 1 mA
// (of an intensity: re 1). The lapse rate is fixed at 0.02 (TwoIntervalPosterior.h).
// Grid: α = 20 lg F − 12 … + 9 dB by 0.5, β in {2, 4, 8, 16}; prior normal on α, even on β. Levels are those of the
// LevelGrid above 0. Next is the level whose expected posterior entropy is least (the weakest of those within
// kEqualEntropy), but no level four times in a row as long as there is another. The first trial and every 8th (8, 16,
// 24 ...) is easy: the level nearest to 1.5 times the estimate. The estimate is the posterior mean of α, where 80 % of
// the answers are right; its interval is the posterior's 2.5 and 97.5 %, each cell of the α grid taken as even.
//
// The same settings, seed and answers give the same trials. A trial takes about 0.1 ms on 30 levels.
//
// Thread-safety: none; one owner.
#pragma once

#include <optional>
#include <vector>

#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/analysis/psychophysics/TwoIntervalPosterior.h"
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

    /// The same until it is answered; nothing when done().
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

}  // namespace tacto
