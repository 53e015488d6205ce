// StudyPerson.h - what the study report says about one participant: a sentence a session, then what was presented and
// answered, ratings, encodings and the person over their sessions.
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
    /// `participant` outlives it. Errors: as identify().
    [[nodiscard]] static Result<StudyPerson> analysed(const ParticipantRecord& participant);

    /// The sessions with test trials, in their order.
    [[nodiscard]] std::vector<AnalysedSession> tested() const;
    /// The figures of the first of these; without one, whether the last session had a usable range.
    [[nodiscard]] PersonResult result() const;

    void addHeadlines(std::vector<ReportBlock>& blocks) const;
    /// Adds nothing for a person without a session to show. Errors: addPredicted(), addVibration(), addOverSessions().
    [[nodiscard]] Result<void> add(std::vector<ReportBlock>& blocks, Captions& captions, Modality modality,
                                   bool simulated) const;

private:
    explicit StudyPerson(const ParticipantRecord& participant) : participant_(&participant) {}
    [[nodiscard]] Result<void> addSession(std::vector<ReportBlock>& blocks, Captions& captions,
                                          const AnalysedSession& one, bool massager, bool simulated) const;
    /// The name, with what their figures rest on where that is not a person on real devices.
    [[nodiscard]] std::string name() const { return namedWith(participant_->basis, participant_->about.code); }

    const ParticipantRecord* participant_;
    std::vector<AnalysedSession> sessions_;
};

// The motions of a massager's motor in a session, beside its commands.

/// One sentence where no accelerometer was on it. Errors: as judgeVibration().
[[nodiscard]] Result<void> addVibration(std::vector<ReportBlock>& blocks, Captions& captions,
                                        const BidsSession& session, const std::string& name);

}  // namespace tacto
