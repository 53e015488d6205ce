// PilotCare.h - what protects the participant around the trials: the gates that only the running bench can ask, skin,
// electrodes, ratings, side effects (pilot.md sections 3 and 4).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/pilot/PilotStage.h"

namespace tacto {

/// What a stimulator, or a massager, and a study's trains lack before they may be used on a participant: one sentence
/// without its full stop; empty where nothing is missing.
[[nodiscard]] std::string machineLacks(const DeviceSet& devices, const Profile& profile, LevelUnit unit);

class PilotCare {
public:
    /// `stage` outlives it, and measures |Z| again once electrodes may have changed: within 30 % of the session's
    /// first, as before a block. A session that is stopped for good asks for skin and side effects all the same.
    explicit PilotCare(PilotStage& stage);
    PilotCare(const PilotCare&) = delete;
    PilotCare& operator=(const PilotCare&) = delete;

    /// Runs in every part: machine, both STOPs, and the electrodes, or with a massager the masking noise. The first
    /// part also asks for the skin before and the electrodes' lot; a later one whether electrodes or massager were left
    /// untouched. Errors: Stopped with the gate's sentence, when the session has ended.
    [[nodiscard]] Result<void> checklist();
    /// |Z| before a block, within 30 % of the session's first; a massager has none. Errors: as checklist().
    [[nodiscard]] Result<void> beforeBlock(int block);
    /// Told of a score that ends a session and is an adverse event: of the study, not of the session alone. Its error
    /// is skin()'s.
    std::function<Result<void>(const std::string& moment, int score)> skinReacted;
    /// `moment`: "before", "break 3", "after". Errors: Stopped where it ends the session.
    [[nodiscard]] Result<void> skin(const std::string& moment);
    /// Each condition is felt once more without its name, and rated. After a second encoding, also which of the two was
    /// easier, and which is more like touch.
    [[nodiscard]] Result<void> ratings(const std::vector<PresentedCondition>& conditions);
    /// `moment`: "before", "after".
    [[nodiscard]] Result<void> sideEffects(const std::string& moment);
    /// The row of a gate; ends the session where it does not hold.
    [[nodiscard]] Result<void> gate(const std::string& name, bool holds, const std::string& sentence);

private:
    [[nodiscard]] Result<void> machine();
    [[nodiscard]] Result<void> stopTest(PromptTo by);
    [[nodiscard]] Result<void> compareEncodings();
    [[nodiscard]] Result<void> electrodes();
    [[nodiscard]] Result<void> massager();
    [[nodiscard]] Result<void> mustHold(const std::string& name, const char* asked, const char* question,
                                        const char* sentence);
    /// |Z| of the second of two checks that agree; the session ends if they still disagree after the third seating.
    [[nodiscard]] Result<double> checkedTwice();
    /// |Z|, into the record as `name`; the session ends where it is not what it was at first after the third seating.
    [[nodiscard]] Result<void> asAtFirst(const std::string& name);
    [[nodiscard]] std::string part() const;
    [[nodiscard]] const nlohmann::json* firstImpedance() const;

    PilotStage& stage_;
};

}  // namespace tacto
