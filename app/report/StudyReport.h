// StudyReport.h - the three reports of a pilot study: for those who run it, for its ethics committee, and one page in
// plain words for a participant.
//
// Reports are made on request and are never stored in the study folder. Those for the committee and the participant
// contain no code; the study's own report does, and says so.
//
// Thread-safety: the GUI thread (drawn figures are widgets).
#pragma once

#include <string>

#include "app/report/ReportContent.h"
#include "core/base/Result.h"
#include "core/pilot/ParticipantWords.h"
#include "core/sharing/results/StudyResults.h"

namespace tacto {

/// Each person's result comes first, then what few people show together, encodings, and one person over sessions.
/// Errors: as identify().
[[nodiscard]] Result<ReportContent> studyReport(const StudyRecord& study);

/// Contains approval, consents, gates, stops, skin, adverse events, the flow of participants, and all that participants
/// read in each approved language; no answers, no codes. `words`: those that there are now (StudyWords.h).
[[nodiscard]] ReportContent committeeReport(const StudyRecord& study,
                                            const Result<std::vector<ParticipantWords>>& words = {});

/// Errors: NotFound for a code that is not in the study; as identify().
[[nodiscard]] Result<ReportContent> participantReport(const StudyRecord& study, const std::string& code);

}  // namespace tacto
