// StudyFigures.h - the figures of a study's participants of one kind, from their records.
//
// Thread-safety: pure functions.
#pragma once

#include "core/analysis/identification/EncodingsOverPeople.h"
#include "core/sharing/results/StudyResults.h"

namespace tacto {

/// A session with its results.
struct AnalysedSession {
    const SessionRecord* session = nullptr;
    Identification found;
};
/// Returns all sessions, in order; they refer to `participant`. Errors: as identify().
[[nodiscard]] Result<std::vector<AnalysedSession>> analysedSessions(const ParticipantRecord& participant);

/// Returns the mean over the conditions, from 5 (totally natural) to 1 (totally unnatural); NaN without ratings.
[[nodiscard]] double naturalnessOf(const BidsSession& session);
/// Response times of the answered test trials, sorted; `condition` empty: of all conditions.
[[nodiscard]] std::vector<double> responseTimes(const BidsSession& session, const std::string& condition = {});
/// `massager`: levels are strengths.
[[nodiscard]] std::vector<SessionFigures> sessionFiguresOf(const std::vector<AnalysedSession>& sessions,
                                                           const std::string& name, bool massager);
[[nodiscard]] PersonEncodings personEncodings(const std::vector<AnalysedSession>& sessions, const std::string& name);

/// `part`: from byBasis(). Participants who withdrew are left out. Errors: as identify().
[[nodiscard]] Result<StudyFigures> studyFigures(SessionBasis basis, const StudyRecord& part);

}  // namespace tacto
