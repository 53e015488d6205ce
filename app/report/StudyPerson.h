// StudyPerson.h - one participant in the study report: a sentence per session, then presentations and answers, ratings,
// encodings and the comparison of their sessions.
//
// Thread-safety: as StudyReport.
#pragma once

#include <string>
#include <vector>

#include "app/report/ReportContent.h"
#include "app/report/StudyOverSessions.h"
#include "core/analysis/identification/FewPeople.h"
#include "core/base/Result.h"
#include "core/sharing/BidsStudy.h"
#include "core/sharing/results/StudyResults.h"

namespace tacto {

class StudyPerson {
public:
    /// `participant` must outlive the object. Errors: as identify().
    [[nodiscard]] static Result<StudyPerson> analysed(const ParticipantRecord& participant);

    /// All sessions, in order.
    [[nodiscard]] const std::vector<AnalysedSession>& sessions() const noexcept { return sessions_; }
    /// Returns the sessions with test trials, in order.
    [[nodiscard]] std::vector<AnalysedSession> tested() const;
    /// Returns the results of the first tested session; without one, whether the last session had a usable range.
    [[nodiscard]] PersonResult result() const;
    /// Returns the results with each encoding, all sessions together.
    [[nodiscard]] PersonEncodings encodings() const;
    [[nodiscard]] const std::string& code() const noexcept { return participant_->about.code; }
    [[nodiscard]] SessionBasis basis() const noexcept { return participant_->basis; }
    [[nodiscard]] bool simulated() const noexcept { return isSimulatedBasis(participant_->basis); }
    /// Returns the name, with the basis of the results unless it is a person with real devices.
    [[nodiscard]] std::string name() const { return namedWith(participant_->basis, participant_->about.code); }

    void addHeadlines(std::vector<ReportBlock>& blocks) const;
    /// Adds nothing for a person without sessions. Errors: as addPredicted(), addVibration(), addOverSessions().
    [[nodiscard]] Result<void> add(std::vector<ReportBlock>& blocks, Captions& captions, Modality modality) const;

private:
    explicit StudyPerson(const ParticipantRecord& participant) : participant_(&participant) {}
    [[nodiscard]] Result<void> addSession(std::vector<ReportBlock>& blocks, Captions& captions,
                                          const AnalysedSession& one, bool massager) const;

    const ParticipantRecord* participant_;
    std::vector<AnalysedSession> sessions_;
};

// The measured motion of a massager's motor in a session, compared with its commands.

/// Adds one sentence if the massager had no accelerometer. Errors: as judgeVibration().
[[nodiscard]] Result<void> addVibration(std::vector<ReportBlock>& blocks, Captions& captions,
                                        const BidsSession& session, const std::string& name);

}  // namespace tacto
