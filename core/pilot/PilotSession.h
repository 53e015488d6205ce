// PilotSession.h - one session of a pilot study from its checklist to its results. The script object `pilot` calls this
// class.
//
// Uses the bench, the two people and the record; the caller owns the SessionRequest, the study's gates and the files.
// When the same protocol is called again on the rows of an earlier part, the session continues where that part ended.
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
    /// All arguments must outlive the session. `truth`: a virtual participant's observer, for predictions; null for a
    /// person. `parts`: number of files of the session, including the present file.
    PilotSession(Bench& bench, PilotParticipant& participant, PilotRecord& record, PilotSettings settings,
                 const VirtualObserver* truth, int parts);

    /// Plans the session and runs the checklist; in a later part, first writes the row `resumed`. `withTrials`: the
    /// plan contains trials. Errors: as PilotStage.
    [[nodiscard]] Result<void> begin(bool withTrials);
    /// Makes this part continue the session of `part`, whose hash chain ends in `chainHead`; begin() records both.
    void resumesFrom(std::string part, std::string chainHead);

    /// Checks before each block that the study is still approved and has time left. If empty, nothing is checked.
    std::function<Result<void>()> mayGoOn;
    /// Checks approval, time and electrodes. Errors: Stopped with the gate's sentence, when the session has ended.
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
    /// Returns the sentence with which every result begins.
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
