// PilotSession.h - one session of a pilot study from its checklist to its results: what the script object `pilot`
// calls.
//
// Built on the bench, the two people and the record; SessionRequest, gates of the study and files belong to the caller.
// The same protocol called again on the rows of an earlier part continues where that ended.
//
// Thread-safety: one caller, the script's thread; endRun() and cancel() from any thread.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/analysis/identification/Identification.h"
#include "core/analysis/psychophysics/VirtualObserver.h"
#include "core/pilot/PilotCare.h"
#include "core/pilot/PilotIdentification.h"
#include "core/pilot/PilotThresholds.h"

namespace tacto {

class PilotSession {
public:
    /// All arguments outlive the session. `truth`: a virtual participant's, for predictions; null for a person.
    /// `parts`: files of the session, with this one.
    PilotSession(Bench& bench, PilotParticipant& participant, PilotRecord& record, PilotSettings settings,
                 const VirtualObserver* truth, int parts);

    /// Plan and checklist; in a later part the row `resumed` comes first. `resumedFrom` names the part before and its
    /// chain head. `withTrials`: the plan has trials. Errors: as PilotStage.
    [[nodiscard]] Result<void> begin(bool withTrials);
    /// This part continues the session of `part`; begin() then states it in the first row.
    void resumesFrom(std::string part, std::string chainHead);

    /// Asks before each block whether the study is still approved and its time not over. Empty: nothing is asked.
    std::function<Result<void>()> mayGoOn;
    /// Approval, time and electrodes. Errors: Stopped with the gate's sentence, when the session has ended.
    [[nodiscard]] Result<void> beforeBlock(int block);

    [[nodiscard]] PilotStage& stage() noexcept { return stage_; }
    [[nodiscard]] PilotCare& care() noexcept { return care_; }
    [[nodiscard]] PilotThresholds& thresholds() noexcept { return thresholds_; }
    [[nodiscard]] PilotIdentification& identification() noexcept { return identification_; }
    /// Does what PilotStage::endRun() does.
    void endRun() noexcept { stage_.endRun(); }
    void cancel() noexcept { stage_.cancel(); }

    /// Results of `run pilot-thresholds` (pilot.md section 10).
    [[nodiscard]] nlohmann::json thresholdResults() const;
    /// Results of `run pilot-identification`. Errors: as identify() and fitOf().
    [[nodiscard]] Result<nlohmann::json> identificationResults() const;
    /// The sentence with which every result begins.
    [[nodiscard]] Result<std::string> headlineText() const;

private:
    [[nodiscard]] nlohmann::json participantJson() const;
    [[nodiscard]] nlohmann::json truthJson() const;
    [[nodiscard]] Result<Identification> found() const;
    [[nodiscard]] Result<void> addPredicted(nlohmann::json& results) const;

    PilotStage stage_;
    PilotCare care_;
    PilotThresholds thresholds_;
    PilotIdentification identification_;
    const VirtualObserver* truth_;
    const int parts_;
    std::string resumedPart_, resumedHead_;
};

}  // namespace tacto
