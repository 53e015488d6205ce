// UnfinishedSession.h - the session that a participant began and did not end: whether it is resumed, with the same
// device and procedure, or ends before another begins.
//
// Thread-safety: one caller at a time for a study.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/run/PilotRows.h"
#include "core/devices/DeviceSet.h"
#include "core/study/Study.h"

namespace tacto {

class UnfinishedSession {
public:
    /// The settings of the run about it.
    struct Choice {
        std::string wanted;    ///< "end" or "resume"
        std::string protocol;  ///< the run's protocol
        bool inWindow = false;
    };
    /// Stands for no unfinished session.
    UnfinishedSession() = default;
    /// Changes nothing. Errors: NotFound where neither end nor resume is wanted, and for another protocol; kGateRefused
    /// for a session that was interrupted too long ago, and as Study::stillApproved(); as pilotRows().
    [[nodiscard]] static Result<UnfinishedSession> choose(const Study& study, const Participant& who,
                                                          const Choice& choice);

    /// The session that is resumed; nothing where a new one begins.
    [[nodiscard]] const std::optional<StudySession>& continued() const noexcept { return continued_; }
    /// What was recorded of the resumed session; empty for a new one.
    [[nodiscard]] const PilotRows& earlier() const noexcept { return earlier_; }

    /// The discomfort limit and the range were found with the first part's device and hold for no other. Errors:
    /// kGateRefused naming both.
    [[nodiscard]] Result<void> sameDevice(const DeviceSet& devices) const;
    /// Levels hold for one kind of train, and answers of two procedures do not make one result. Errors: kGateRefused.
    [[nodiscard]] Result<void> sameProcedure(std::string_view runSha256) const;

    /// Books the resumed part, or the new session, and before it the end of the one that ends: but only once every gate
    /// lets another begin, because until then it can be continued. `remarks` tells what was ended. Errors: as
    /// Study::mayBegin(), endSession(), continueSession() and beginSession().
    [[nodiscard]] Result<BegunSession> begin(Study& study, const SessionRequest& request,
                                             std::vector<std::string>& remarks) const;

private:
    struct Ends {
        StudySession session;
        StudySessionState state;
    };
    [[nodiscard]] Result<void> mayResume(const Study& study) const;
    /// An option, or what the window offers.
    [[nodiscard]] std::string_view whatEnds() const;

    std::string code_;  // the participant's code
    bool inWindow_ = false;
    std::optional<Ends> ends_;
    std::optional<StudySession> continued_;
    PilotRows earlier_;
};

}  // namespace tacto
