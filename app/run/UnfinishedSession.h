// UnfinishedSession.h - the session that a participant began and did not end: whether it goes on, with the device and
// the procedure that it was begun with, or ends before another begins.
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
    /// What the run's settings say about it.
    struct Choice {
        std::string wanted;    ///< "end" or "resume"
        std::string protocol;  ///< the run's protocol
        bool inWindow = false;
    };
    /// There is none.
    UnfinishedSession() = default;
    /// Nothing is changed. Errors: NotFound where neither end nor resume is wanted, and for another protocol;
    /// kGateRefused for one that was interrupted too long ago, and as Study::stillApproved(); as pilotRows().
    [[nodiscard]] static Result<UnfinishedSession> choose(const Study& study, const Participant& who,
                                                          const Choice& choice);

    /// The session that goes on; nothing where a new one begins.
    [[nodiscard]] const std::optional<StudySession>& continued() const noexcept { return continued_; }
    /// What was recorded of the session that goes on; empty for a new one.
    [[nodiscard]] const PilotRows& earlier() const noexcept { return earlier_; }

    /// What was too strong, and the range, were found with the first part's device and hold for no other. Errors:
    /// kGateRefused naming both.
    [[nodiscard]] Result<void> sameDevice(const DeviceSet& devices) const;
    /// Levels hold for one kind of train, and answers of two procedures do not make one result. Errors: kGateRefused.
    [[nodiscard]] Result<void> sameProcedure(std::string_view runSha256) const;

    /// Books the part that goes on, or the session that begins, and before it the end of the one that ends: not before
    /// every gate lets another begin, because until then it can be continued. What was ended is said in `remarks`.
    /// Errors: as Study::mayBegin(), endSession(), continueSession() and beginSession().
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
