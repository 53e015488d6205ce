// PilotIdentification.h - the rest of a session: familiarisation, training, test blocks with drift checks and breaks,
// and their results (pilot.md section 4).
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/analysis/psychophysics/QuestPlus.h"
#include "core/analysis/psychophysics/TrialPlan.h"
#include "core/analysis/vibration/VibrationSeparability.h"
#include "core/pilot/PilotThresholds.h"

namespace tacto {

class PilotIdentification {
public:
    /// All arguments must outlive this object.
    PilotIdentification(PilotStage& stage, PilotThresholds& thresholds) : stage_(stage), thresholds_(thresholds) {}

    /// Plans the order of the whole session and its seed, or reads the plan from its row if one is stored. Call this
    /// before anything is presented; it copies the seed and the numbers of trials of a stored plan to the stage's
    /// settings. `withTrials`: false for thresholds alone. Errors: as PilotStage; as planTrials(); ParseError if a
    /// stored plan differs from the plan drawn from its seed.
    [[nodiscard]] Result<void> plan(bool withTrials);

    // To be called once the range is known and usable. Errors: as PilotStage; InvalidArgument out of order.

    [[nodiscard]] Result<void> familiarise();
    [[nodiscard]] Result<void> train();
    /// `block` counts from 1.
    [[nodiscard]] Result<void> testBlock(int block);
    /// Asks before a later block whether the lowest level is still felt. If it is not, marks the block and asks the
    /// participant whether to continue; returns false if they end the session here.
    [[nodiscard]] Result<bool> driftCheck(int block);
    /// The break after block `block`: the output is off for at least `time`, until both people press to continue.
    [[nodiscard]] Result<void> takeBreak(int block, Seconds time);

    [[nodiscard]] const std::vector<PresentedCondition>& presented() const noexcept { return presented_; }
    [[nodiscard]] std::vector<std::string> labels() const;
    /// The conditions, in the order in which every question shows them.
    [[nodiscard]] std::vector<std::string> places() const;
    [[nodiscard]] nlohmann::json planJson() const { return plan_; }
    /// Answered trials of the plan, in order, including those of earlier parts.
    [[nodiscard]] const std::vector<IdentificationTrial>& trials() const noexcept { return trials_; }
    /// For each of trials(): how long trains had been given before the trial.
    [[nodiscard]] const std::vector<Seconds>& stimulatedBefore() const noexcept { return stimulated_; }
    /// For each of trials() that was not empty: what a massager's motor did; NaN if it was not measured.
    [[nodiscard]] const std::vector<VibrationTrial>& vibrations() const noexcept { return vibrations_; }
    /// [{block, detection_ma (detection_intensity with a massager) {value, low, high}, probability, rests, adapted}]
    [[nodiscard]] const nlohmann::json& driftJson() const noexcept { return drift_; }

private:
    [[nodiscard]] Result<std::vector<PlannedTrial>> drawn() const;
    [[nodiscard]] Result<bool> goesOnAdapted(int block);
    [[nodiscard]] Result<void> prepare();
    [[nodiscard]] StageTrial stageTrial(const PlannedTrial& planned) const;
    [[nodiscard]] Result<StageAnswer> present(const PlannedTrial& planned, const StageTrial& trial);
    [[nodiscard]] std::vector<PlannedTrial> of(TrialPhase phase) const;
    [[nodiscard]] std::string nameOfCondition(const PlannedTrial& planned) const;
    void keep(const PlannedTrial& planned, const StageTrial& trial, const StageAnswer& answer);
    [[nodiscard]] Result<void> feedback(const PlannedTrial& planned, const StageTrial& trial, bool right,
                                        bool replayed);

    PilotStage& stage_;
    PilotThresholds& thresholds_;
    nlohmann::json plan_;
    std::vector<PlannedTrial> planned_;
    std::vector<PresentedCondition> presented_;
    std::vector<IdentificationTrial> trials_;
    std::vector<Seconds> stimulated_;  // one for each of trials_
    std::vector<VibrationTrial> vibrations_;
    nlohmann::json drift_ = nlohmann::json::array();
    double lastDetection_ = kNaN;
    int breaks_ = 0;
};

}  // namespace tacto
