// QuestPlus.h - QUEST+ for detection: next comes the level with the least expected entropy (pilot.md section 4).
//
// Model (Watson, Journal of Vision 17(3):10, 2017): p(x) = 0.5 + 0.48 (1 − exp(−10^(β (x − α)/20))), x in dB re 1 mA
// (for an intensity: re 1). The lapse rate is fixed at 0.02 (TwoIntervalTrials.h).
// Grid: α = 20 lg F − 12 … + 9 dB in steps of 0.5, β in {2, 4, 8, 16}; prior normal in α, uniform in β. The levels are
// those of the LevelGrid above 0. Next comes the level with the least expected posterior entropy (the weakest within
// kEqualEntropy), but no level four times in a row if there is another. Trials 1, 8, 16, 24 ... are easy: the level
// nearest to 1.5 times the estimate. The estimate is the posterior mean of α, the level with 80 % right answers. Its
// interval is the posterior's 2.5 and 97.5 % points, with uniform density in each cell of the α grid.
//
// The same settings, seed and answers give the same trials. A trial takes about 0.1 ms on 30 levels.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/analysis/psychophysics/TwoIntervalTrials.h"
#include "core/analysis/statistics/Estimate.h"

namespace tacto {

struct QuestPlusSettings {
    double felt = 0;         ///< F, first felt level in the grid's unit: centre of the α grid, first estimate
    double prior = 0;        ///< median of the prior for α, in the grid's unit; 0: F − 1 dB
    double priorSd_db = 4;   ///< > 0
    double first = 0;        ///< the first trial is at the level nearest to 1.5 times this; 0: F
    std::size_t least = 24;  ///< smallest number of trials before the precision may end the run; ≥ 1
    std::size_t most = 40;   ///< largest number of trials; ≥ least
    double enough_db = 0.8;  ///< posterior standard deviation that ends the run; 0: only `most` ends it
    std::string stream = "detection";  ///< name of the random order of intervals
};

struct QuestPlusResult {
    Estimate estimate;  ///< estimate of α with its 95 % interval, in the grid's unit
    double sd_db = std::numeric_limits<double>::quiet_NaN();
    double slope = std::numeric_limits<double>::quiet_NaN();  ///< posterior mean of β
    /// More than 2.5 % of the posterior lies at one end of the α grid. The threshold may then lie outside the grid, and
    /// the interval is too narrow.
    bool atEdge = false;
    IntervalShares intervals;
    std::vector<AnsweredTwoIntervalTrial> trials;
};

class QuestPlus {
public:
    /// Errors: InvalidArgument naming the setting, its value and what is accepted.
    [[nodiscard]] static Result<QuestPlus> create(const LevelGrid& grid, const QuestPlusSettings& settings,
                                                  std::uint64_t seed);

    /// Returns the next trial, unchanged until it is answered; nothing if done().
    [[nodiscard]] std::optional<TwoIntervalTrial> next() const;
    /// Errors: InvalidArgument for a value that is not an interval, or if done(); the state then stays unchanged.
    [[nodiscard]] Result<void> answer(TrialInterval said);
    [[nodiscard]] bool done() const;
    /// Returns the estimate from the answers so far, or from the prior if there are none.
    [[nodiscard]] QuestPlusResult result() const;
    /// Posterior probability that α lies above `level` (> 0, in the grid's unit).
    [[nodiscard]] double probabilityAbove(double level) const;

    /// Probability of a right answer according to the model.
    [[nodiscard]] static double probabilityRight(double level_db, double alpha_db, double slope) noexcept;

private:
    QuestPlus(const LevelGrid& grid, const QuestPlusSettings& settings, std::uint64_t seed);
    void choose();
    [[nodiscard]] EvenDensity ofAlpha() const;

    LevelGrid grid_;
    QuestPlusSettings settings_;
    TwoIntervalOrder order_;
    TwoIntervalPosterior posterior_;  // choices: the levels above 0; cell index: α · slopes + β
    std::size_t chosen_ = 1;          // index of a level
    IntervalShares shares_;
    std::vector<AnsweredTwoIntervalTrial> trials_;
};

// The course of a detection run, from its levels and answers alone: what figures show. For answers to QUEST+ trials the
// estimates are those of the run; for answers to a staircase they are those that QUEST+ would have had.

struct LevelAnswer {
    double level = 0;  ///< > 0
    bool correct = false;
};

struct DetectionCourse {
    std::vector<Estimate> threshold;  ///< α after each answer, in the levels' unit
    std::vector<Estimate> right;      ///< posterior mean and 95 % points of p(x) at each level of `at`
};
/// `felt`: F of the prior, > 0. `at`: levels > 0. Errors: InvalidArgument naming the value and what is accepted.
[[nodiscard]] Result<DetectionCourse> detectionCourse(std::span<const LevelAnswer> answers, double felt,
                                                      std::span<const double> at);

// Drift check: tests before each later block whether the lowest condition is still felt (pilot.md section 4).
//
// Runs 12 QUEST+ trials with the last estimate of the threshold α as prior (2.5 dB). If P(1.1 α > I_min) ≥ 0.8 (I_min:
// lowest level), the participant rests for 5 min and is checked again with the newest estimate, up to three times. If
// nothing changes, the block is marked as adapted and still takes place. The session's range never changes.
//
// The same settings, seed and answers give the same trials.

struct DriftCheckSettings {
    double felt = 0;        ///< first felt level of the ascending limits, in the grid's unit: centre of the α grid
    double last = 0;        ///< last estimate of α; > 0
    double min = 0;         ///< I_min, the lowest level of the range; > 0
    std::size_t block = 0;  ///< number of the following block; part of the name of the interval order
    double priorSd_db = 2.5;
    std::size_t trials = 12;
    double margin = 1.1;
    double threshold = 0.8;
    std::size_t rests = 3;  ///< largest number of rests
};

enum class DriftStep { Trial, Rest, Done };

struct DriftResult {
    Estimate estimate;                                              ///< from the last check, in the grid's unit
    double probability = std::numeric_limits<double>::quiet_NaN();  ///< P(margin · α > I_min) in the last check
    std::size_t rests = 0;
    bool adapted = false;                 ///< true if the threshold was still too high after the last rest
    std::vector<QuestPlusResult> checks;  ///< all completed checks
};

class DriftCheck {
public:
    /// Errors: InvalidArgument naming the setting, its value and what is accepted.
    [[nodiscard]] static Result<DriftCheck> create(const LevelGrid& grid, const DriftCheckSettings& settings,
                                                   std::uint64_t seed);

    [[nodiscard]] DriftStep step() const noexcept { return step_; }
    /// Returns nothing unless step() is Trial.
    [[nodiscard]] std::optional<TwoIntervalTrial> next() const;
    /// Errors: InvalidArgument for a value that is not an interval, or if no answer is expected.
    [[nodiscard]] Result<void> answer(TrialInterval said);
    /// Reports the end of a rest. Errors: InvalidArgument if no rest was requested.
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
