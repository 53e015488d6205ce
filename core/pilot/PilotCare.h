// PilotCare.h - what protects the participant around the trials: checks that only the running bench can make, and
// checks of skin, electrodes, ratings and side effects (pilot.md sections 3 and 4).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/pilot/PilotStage.h"

namespace tacto {

/// Returns what a stimulator or massager, or a study's trains, lack before they may be used on a participant: one
/// sentence without its full stop, or an empty text if nothing is missing.
[[nodiscard]] std::string machineLacks(const DeviceSet& devices, const Profile& profile, LevelUnit unit);

class PilotCare {
public:
    /// `stage` must outlive this object. Electrodes that were touched must measure within 30 % of the session's first
    /// impedance. A session that is stopped for good still asks for skin and side effects.
    explicit PilotCare(PilotStage& stage);
    PilotCare(const PilotCare&) = delete;
    PilotCare& operator=(const PilotCare&) = delete;

    /// Checks, in every part, the machine, both STOPs, and the electrodes (or a massager's masking noise). The first
    /// part also asks for the skin before and the electrodes' lot; later parts, whether electrodes or massager were
    /// left untouched. Errors: Stopped with the gate's sentence, when the session has ended.
    [[nodiscard]] Result<void> checklist();
    /// Has the participant read what comes; once in a session.
    [[nodiscard]] Result<void> introduce();
    /// Checks that the impedance is within 30 % of the session's first, except with a massager. Errors: as checklist().
    [[nodiscard]] Result<void> beforeBlock(int block);
    /// Called with a score that ends the session and is an adverse event of the whole study. skin() returns its error.
    std::function<Result<void>(const std::string& moment, int score)> skinReacted;
    /// `moment`: "before", "break 3", "after". Errors: Stopped if the score ends the session.
    [[nodiscard]] Result<void> skin(const std::string& moment);
    /// Presents each condition once more without its name and asks for a rating. After a second encoding, also asks
    /// which of the two encodings was easier, and which is more like touch.
    [[nodiscard]] Result<void> ratings(const std::vector<PresentedCondition>& conditions);
    /// `moment`: "before" or "after".
    [[nodiscard]] Result<void> sideEffects(const std::string& moment);
    /// Writes the row of a gate, and ends the session if `holds` is false.
    [[nodiscard]] Result<void> gate(const std::string& name, bool holds, const std::string& sentence);

private:
    [[nodiscard]] Result<void> machine();
    [[nodiscard]] Result<void> stopTest(PromptTo by);
    [[nodiscard]] Result<void> compareEncodings();
    [[nodiscard]] Result<void> electrodes();
    [[nodiscard]] Result<void> massager();
    [[nodiscard]] Result<void> mustHold(const std::string& name, const char* asked, const char* question,
                                        const char* sentence);
    /// The second of two impedances that agree; ends the session if they still disagree after the third seating.
    [[nodiscard]] Result<double> checkedTwice();
    /// Records the impedance as `name`; ends the session if it still differs from the first after the third seating.
    [[nodiscard]] Result<void> asAtFirst(const std::string& name);
    [[nodiscard]] std::string part() const;
    [[nodiscard]] const nlohmann::json* firstImpedance() const;

    PilotStage& stage_;
};

}  // namespace tacto
