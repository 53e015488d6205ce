// PilotThresholds.h - the first three steps of a session: ascending limits, detection and the personal range (pilot.md
// section 4), and the comparison of strengths if the study has it (section 8). Each step is done once; after a resume
// it returns the results in its rows.
#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/analysis/psychophysics/AscendingLimits.h"
#include "core/analysis/psychophysics/PersonalRange.h"
#include "core/analysis/psychophysics/QuestPlus.h"
#include "core/analysis/psychophysics/Staircase.h"
#include "core/analysis/psychophysics/StrengthComparison.h"
#include "core/pilot/PilotStage.h"
#include "core/study/StudySettings.h"

namespace tacto {

[[nodiscard]] Result<DetectionMethod> detectionMethodFrom(std::string_view name);

class PilotThresholds {
public:
    /// `stage` must outlive this object.
    explicit PilotThresholds(PilotStage& stage) : stage_(stage) {}

    // Call these in this order. Errors: as PilotStage; InvalidArgument out of order.

    [[nodiscard]] Result<void> ascendingLimits();
    /// If no level was felt, there is nothing to measure: finishes at once, without an estimate.
    [[nodiscard]] Result<void> detection(DetectionMethod method);
    [[nodiscard]] Result<void> range();
    /// After a range that is not usable, asks the operator whether to measure once more, kMaxRepeats times at most.
    /// Yes: the electrodes are seated again, and the three steps above begin anew, below what was called too strong.
    [[nodiscard]] Result<bool> measureAgain();
    static constexpr int kMaxRepeats = 2;
    /// Measures the Weber fraction of strength within the range, by 40 trials. Without a usable range there is nothing
    /// to measure.
    [[nodiscard]] Result<void> comparison();

    /// The thresholds part of the results; detection, range and comparison are null until they are measured.
    [[nodiscard]] nlohmann::json toJson() const;
    /// The range as its row states it; null before it was measured.
    [[nodiscard]] const nlohmann::json& rangeJson() const noexcept { return rangeRow_; }
    [[nodiscard]] const AscendingResult& limits() const noexcept { return ascending_; }
    [[nodiscard]] const std::optional<PersonalRangeResult>& found() const noexcept { return range_; }
    /// Posterior mean of the detection threshold; NaN without an estimate.
    [[nodiscard]] double estimate() const noexcept { return estimate_.value; }
    /// The levels that detection and drift trials may use; set by detection().
    [[nodiscard]] const std::optional<LevelGrid>& grid() const noexcept { return detectionGrid_; }
    /// Runs one two-interval trial; the result says whether the answer was right.
    [[nodiscard]] Result<TrialInterval> twoIntervals(const std::string& name, const TwoIntervalTrial& asked,
                                                     const std::string& phase);

private:
    /// Each repeat has a random order of its own.
    [[nodiscard]] std::uint64_t seed() const { return stage_.settings().seed + static_cast<std::uint64_t>(repeats_); }
    [[nodiscard]] std::string numbered(const char* name) const;
    [[nodiscard]] Result<LevelGrid> ascendingGrid();
    [[nodiscard]] Result<void> present(AscendingLimits& limits, const AscendingPresentation& next);
    [[nodiscard]] Result<LevelGrid> belowTooStrong() const;
    template <class Procedure, class Settings>
    [[nodiscard]] Result<void> measureBy(Settings settings);
    [[nodiscard]] nlohmann::json describe(const PersonalRangeResult& found) const;
    /// The common part of trials with two intervals; `held`: the interval with the train, or with the stronger one.
    [[nodiscard]] Result<TrialInterval> askInterval(StageTrial trial, TrialInterval held, std::size_t number);

    PilotStage& stage_;
    std::optional<LevelGrid> grid_;
    AscendingResult ascending_;
    std::optional<LevelGrid> detectionGrid_;
    DetectionMethod method_ = DetectionMethod::Quest;
    Estimate estimate_{kNaN, kNaN, kNaN};
    bool estimateAtEdge_ = false;  // the estimate lies at the edge of the range considered, or anywhere beyond
    IntervalShares shares_;
    std::vector<AnsweredTwoIntervalTrial> trials_;
    bool measured_ = false;
    std::optional<PersonalRangeResult> range_;
    nlohmann::json rangeRow_;
    std::optional<StrengthComparisonResult> compared_;
    std::size_t liveSeries_ = 0;
    double tooStrongBefore_ = std::numeric_limits<double>::infinity();  // the lowest of the earlier measurements
    int repeats_ = 0;
    std::size_t ascended_ = 0, detected_ = 0, ranged_ = 0;  // presentations so far of each step, over all repeats
};

}  // namespace tacto
