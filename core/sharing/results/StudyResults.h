// StudyResults.h - the results of a whole study, read from its session files with its key: what exports and reports are
// made from.
//
// Thread-safety: one caller of the study at a time.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/session/SessionTypes.h"
#include "core/sharing/BidsFiles.h"
#include "core/sharing/BidsStudy.h"
#include "core/study/Study.h"

namespace tacto {

/// The stimulator's output in a session, in trials that were answered and in those that were not.
struct SessionExposure {
    std::size_t trains = 0;   ///< impedance checks apart
    double stimulated_s = 0;  ///< each train counts for the interval that it was approved for
    double charge_uC = 0;     ///< the leading phases' charge: current times width, all pulses together
};
/// `commands` are those of all parts. A train whose row has no number adds nothing.
[[nodiscard]] SessionExposure exposureOf(const std::vector<SessionRow>& commands);

/// One session with what only the study may see of it.
struct SessionRecord {
    StudySession about;
    std::vector<SessionRow> rows;  ///< events of all parts, in order
    SessionExposure exposure;
    BidsSession results;
};

struct ParticipantRecord {
    Participant about;
    SessionBasis basis = SessionBasis::Person;  ///< what all their sessions rest on, or the next one if there are none
    std::vector<SessionRecord> sessions;
};

struct StudyRecord {
    StudySettings settings;
    bool rehearsal = false;
    std::uint64_t labelSeed = 0;  ///< Study::labelSeed()
    int places = 0;               ///< Study::firstPlaces(); 0: as many as the settings say
    std::string ledgerHead;
    std::vector<StudyAmendment> amendments;
    std::vector<StudyGoingBack> goingsBack;
    std::vector<ParticipantRecord> participants;  ///< in the order of enrolment; a withdrawn one has no sessions
    std::vector<std::pair<std::string, AdverseEvent>> events;  ///< session id, event
    std::map<std::string, SessionBasis> bases;  ///< by session id, those of withdrawn participants included
};

/// Errors: Unsupported for a study that was opened without its key; as SessionReader.
[[nodiscard]] Result<StudyRecord> readStudyRecord(const Study& study);

/// The study with the participants of one kind only, for each kind that it has, people first. Counts and figures are
/// made of one of these: people and virtual participants are never counted together.
[[nodiscard]] std::vector<std::pair<SessionBasis, StudyRecord>> byBasis(const StudyRecord& study);

/// The part that may leave the study: participants who are active or left.
[[nodiscard]] BidsStudy sharedStudy(const StudyRecord& record);

/// The results of a pilot session, as they may leave the study: trials, thresholds, range, ratings, side effects, skin.
/// `rows` are the events of all parts, in order; `labels` the names offered. Values without a row stay unknown; number,
/// days, complete and parts are the caller's.
[[nodiscard]] BidsSession sessionResults(const std::vector<SessionRow>& rows, std::vector<std::string> labels);

/// A study's results to a BIDS dataset in `out`, which is new or empty and lies outside the study; noted in its ledger
/// first: no export is without its note, and a place inside the study is refused before anything is there.
/// Errors: as readStudyRecord(), bidsFiles(), Study::exported() and writeBids().
[[nodiscard]] Result<void> exportBids(Study& study, const BidsWith& with, const std::filesystem::path& out,
                                      std::string_view version);

}  // namespace tacto
