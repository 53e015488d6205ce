// DriftCheck.h - is the lowest condition still felt? Asked before each later block (pilot.md section 4).
//
// 12 QUEST+ trials with the last estimate as prior (2.5 dB). When P(1.1 α > I_min) ≥ 0.8 the participant rests 5 min
// and is checked again, three times at most, each time with the newest estimate as prior; when that does not help the
// block is adapted, which marks it and ends nothing. The range never changes within a session.
//
// The same settings, seed and answers give the same trials.
//
// Thread-safety: none; one owner.
#pragma once

#include "core/analysis/psychophysics/QuestPlus.h"

namespace tacto {

struct DriftCheckSettings {
    double felt = 0;        ///< F of the session's ascending limits, in the grid's unit: the centre of the α grid
    double last = 0;        ///< last estimate of α; > 0
    double min = 0;         ///< I_min; > 0
    std::size_t block = 0;  ///< that follows: names the order of intervals
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
