// StudyResults.h - the results of a whole study, read from its session files with its key. Exports and reports are made
// from these results.
//
// Thread-safety: one caller at a time for each study.
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

/// What the stimulator delivered in a session, in trials with and without an answer.
struct SessionExposure {
    std::size_t trains = 0;   ///< without impedance checks
    double stimulated_s = 0;  ///< each train counts with the interval for which it was approved
    double charge_uC = 0;     ///< charge of the leading phases: current times width, for all pulses
};
/// `commands` are the commands of all parts. A train without a number in its row is not counted.
[[nodiscard]] SessionExposure exposureOf(const std::vector<SessionRow>& commands);

/// One session, with data that must not leave the study.
struct SessionRecord {
    StudySession about;
    std::vector<SessionRow> rows;  ///< events of all parts, in order
    SessionExposure exposure;
    BidsSession results;
};

struct ParticipantRecord {
    Participant about;
    SessionBasis basis = SessionBasis::Person;  ///< of all their sessions, or of the next if there are none
    std::vector<SessionRecord> sessions;
};

struct StudyRecord {
    StudySettings settings;
    bool rehearsal = false;
    std::uint64_t labelSeed = 0;  ///< Study::labelSeed()
    int places = 0;               ///< Study::firstPlaces(); 0: the number in the settings
    std::string ledgerHead;
    std::vector<StudyAmendment> amendments;
    std::vector<StudyGoingBack> goingsBack;
    std::vector<ParticipantRecord> participants;               ///< in the order of enrolment; no sessions if withdrawn
    std::vector<std::pair<std::string, AdverseEvent>> events;  ///< session id, event
    std::vector<StudyNote> notes;
    std::map<std::string, SessionBasis> bases;  ///< for each session id, including sessions of withdrawn participants
};

/// Errors: Unsupported if the study was opened without its key; as SessionReader.
[[nodiscard]] Result<StudyRecord> readStudyRecord(const Study& study);
/// Takes out sessions that may still go on: their figures would tell a blind operator what was presented (hazard H9).
void leaveOutUnfinished(StudyRecord& study);

/// Splits the study by basis, people first, into one record for each basis. Counts and figures are made from one such
/// record: people and virtual participants are never counted together.
[[nodiscard]] std::vector<std::pair<SessionBasis, StudyRecord>> byBasis(const StudyRecord& study);

/// Whether a particular of the study is about electrodes: with a massager there are none.
[[nodiscard]] bool isOfElectrodes(const StudyLogField& field) noexcept;

/// Whether data of a participant may leave the study: they consented, and did not withdraw. Who had no session has
/// none.
[[nodiscard]] bool mayBeShared(const Participant& participant, bool hadSession);

/// Returns what may leave the study: data of those who may be shared.
[[nodiscard]] BidsStudy sharedStudy(const StudyRecord& record);

/// Returns the results of a pilot session that may leave the study: trials, thresholds, range, ratings, side effects,
/// skin. `rows` are the events of all parts, in order; `labels` the names offered. Values without a row stay unknown;
/// the caller sets number, days, complete and parts.
[[nodiscard]] BidsSession sessionResults(const std::vector<SessionRow>& rows, std::vector<std::string> labels);

/// Exports a study's results as a BIDS dataset to `out`, which must be new or empty and lie outside the study. The
/// ledger records the export first: no export goes unrecorded, and a place inside the study is refused before anything
/// is written. Errors: as readStudyRecord(), bidsFiles(), Study::exported() and writeBids().
[[nodiscard]] Result<void> exportBids(Study& study, const BidsWith& with, const std::filesystem::path& out,
                                      std::string_view version);
/// Returns what such an export would say of age, sex and handedness.
[[nodiscard]] SharedAbout sharedAbout(const Study& study, const BidsWith& asked);

}  // namespace tacto
