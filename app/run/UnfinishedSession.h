// UnfinishedSession.h - a session that a participant began but did not complete. It is resumed with the same device and
// procedure, or ended before another session begins.
//
// Thread-safety: one caller at a time for a study.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/run/PilotRows.h"
#include "core/devices/DeviceSet.h"
#include "core/pilot/ParticipantWords.h"
#include "core/study/Study.h"

namespace tacto {

class UnfinishedSession {
public:
    /// The run's settings about the unfinished session.
    struct Choice {
        std::string wanted;    ///< "end" or "resume"
        std::string protocol;  ///< the run's protocol
        bool inWindow = false;
    };
    /// Represents no unfinished session.
    UnfinishedSession() = default;
    /// Changes nothing. Errors: NotFound if neither end nor resume is wanted, or for another protocol; kGateRefused for
    /// a session that was interrupted too long ago, and as Study::stillApproved(); as pilotRows().
    [[nodiscard]] static Result<UnfinishedSession> choose(const Study& study, const Participant& who,
                                                          const Choice& choice);

    /// The session to resume; nothing if a new session begins.
    [[nodiscard]] const std::optional<StudySession>& continued() const noexcept { return continued_; }
    /// The records of the resumed session; empty for a new session.
    [[nodiscard]] const PilotRows& earlier() const noexcept { return earlier_; }

    /// Checks that the session continues with the device of its first part: discomfort limit and range are valid only
    /// for that device. Errors: kGateRefused naming both devices.
    [[nodiscard]] Result<void> sameDevice(const DeviceSet& devices) const;
    /// Levels hold for one kind of train only, and answers of two procedures cannot be combined. Errors: kGateRefused.
    [[nodiscard]] Result<void> sameProcedure(std::string_view runSha256) const;
    /// The participant reads on in the words with which the session was begun. Errors: kGateRefused.
    [[nodiscard]] Result<void> sameWords(const ParticipantWords& words) const;

    /// Books the resumed part, or ends the unfinished session and books the new one. This happens only after every gate
    /// has agreed, because until then the unfinished session can be continued. `remarks` names what was ended. Errors:
    /// as Study::mayBegin(), endSession(), continueSession() and beginSession().
    [[nodiscard]] Result<BegunSession> begin(Study& study, const SessionRequest& request,
                                             std::vector<std::string>& remarks) const;

private:
    struct Ends {
        StudySession session;
        StudySessionState state;
    };
    [[nodiscard]] Result<void> mayResume(const Study& study) const;
    /// Returns the option or the window's button that ends the session.
    [[nodiscard]] std::string_view whatEnds() const;

    std::string code_;  // the participant's code
    bool inWindow_ = false;
    std::optional<Ends> ends_;
    std::optional<StudySession> continued_;
    PilotRows earlier_;
};

}  // namespace tacto
