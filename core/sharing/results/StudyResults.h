// StudyResults.h - the results of a whole study, read from its session files with its key: what exports and reports are
// made from.
//
// Thread-safety: one caller of the study at a time.
#pragma once

#include <string>
#include <vector>

#include "core/sharing/BidsStudy.h"
#include "core/study/Study.h"

namespace tacto {

/// One session with what only the study may see of it.
struct SessionRecord {
    StudySession about;
    std::vector<SessionRow> rows;  ///< events of all parts, in order
    BidsSession results;
};

struct ParticipantRecord {
    Participant about;
    std::vector<SessionRecord> sessions;
};

struct StudyRecord {
    StudySettings settings;
    bool rehearsal = false;
    std::uint64_t labelSeed = 0;  ///< Study::labelSeed()
    int places = 0;               ///< Study::firstPlaces(); 0: as many as the settings say
    std::string ledgerHead;
    std::vector<StudyAmendment> amendments;
    std::vector<ParticipantRecord> participants;  ///< in the order of enrolment; of a withdrawn one no sessions
    std::vector<std::pair<std::string, AdverseEvent>> events;  ///< session id, event
};

/// Errors: Unsupported for a study that was opened without its key; as SessionReader.
[[nodiscard]] Result<StudyRecord> readStudyRecord(const Study& study);

/// What may leave the study: participants who are active or left.
[[nodiscard]] BidsStudy sharedStudy(const StudyRecord& record);

}  // namespace tacto
