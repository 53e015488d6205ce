// Study.h - a study: its folder (study.json, ledger.tacto, sessions/), its key file, its participants and sessions.
//
// Promise (hazards H8, H11): once a call has returned a value, its change is on disk. Without the key nobody can read a
// code, answer or level: they are sealed under keys that lie elsewhere, in the user's key folder. A withdrawn
// participant's key is destroyed; the ledger and the hash chains stay whole.
//
// One program at a time changes a study; others may read it. If this computer knows of a newer ledger than the study's
// (which is an older copy, or was cut short or recomputed; LedgerEnd.h), no change but goBack() is accepted.
//
// Errors of all calls: NotFound (code), kGateRefused (a gate, Gates.h), Unsupported (the study is from a newer
// Tactoscope, or open without key or for reading), ParseError (damaged), Io. Each is one sentence and changes nothing.
//
// Thread-safety: one caller at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Clock.h"
#include "core/base/Result.h"
#include "core/seal/Passphrase.h"
#include "core/seal/Secret.h"
#include "core/session/RowSeal.h"
#include "core/session/SessionTypes.h"
#include "core/study/Gates.h"
#include "core/study/NextDay.h"
#include "core/study/Participant.h"
#include "core/study/StudyLog.h"
#include "core/study/StudySettings.h"

namespace tacto {

class SessionReader;

enum class StudySessionState { Unfinished, Complete, Stopped };
inline constexpr Word<StudySessionState> kStudySessionStates[] = {{"unfinished", StudySessionState::Unfinished},
                                                                  {"complete", StudySessionState::Complete},
                                                                  {"stopped", StudySessionState::Stopped}};
[[nodiscard]] constexpr std::string_view nameOf(StudySessionState state) noexcept {
    return wordFor(Words<StudySessionState>(kStudySessionStates), state);
}

/// One file of a session. A session that crashed continues in a new file.
struct StudyPart {
    std::string file;  ///< name of the file as 16 hexadecimal digits: sessions/FILE.tacto
    std::chrono::sys_seconds begun{};
};

struct StudySession {
    std::string id;           ///< 16 hexadecimal digits; the first part's id
    std::string participant;  ///< Participant::id
    std::string code;         ///< empty without the key
    int number = 0;           ///< number of this participant's session, from 1
    std::string protocol;
    std::string encoding;
    StudySessionState state = StudySessionState::Unfinished;
    SessionBasis basis = SessionBasis::Person;
    bool opened = true;            ///< false if it was recorded that its bench could not be opened
    std::vector<StudyPart> parts;  ///< in the order in which they began, at least one
    int answered = 0;              ///< number of rows "answer" in the files
};

/// What is lost if a study continues with a ledger that is not the newest known.
struct LedgerLoss {
    std::int64_t row = 0;             ///< number of this ledger's last row ...
    std::chrono::sys_seconds ends{};  ///< ... and when it was written
    std::int64_t newest = 0;          ///< number of the last row of the newest known ledger; 0: not known
    std::string newestHead;
    std::chrono::sys_seconds newestAt{};  ///< 1970 if not known
    std::vector<std::string> rows;        ///< names of the lost rows, as far as known
    std::vector<std::string> enrolled;    ///< codes in the key file that are not in this ledger
    int keysGone = 0;                     ///< participants of this ledger who have no key in the key file
    std::vector<std::string> files;       ///< session files that are not in this ledger
    std::vector<std::string> unsealed;    ///< names of this ledger's rows that were not written with the study's key
    int withdrawn = 0;                    ///< participants who withdrew in this ledger and still have a key

    /// Returns the number of lost rows; 0 if it is not known.
    [[nodiscard]] std::int64_t lost() const noexcept;
    /// Returns the word to confirm goBack(): "lose-4-rows", or "take-2-rows" if none is lost and rows are taken over.
    [[nodiscard]] std::string word() const;
    /// Returns the loss in words, for people.
    [[nodiscard]] std::string sentence() const;
};

/// The request with which a session begins.
struct SessionRequest {
    std::string code;  ///< the code, or "virtual:SEED" for an enrolled virtual participant
    ScriptHash script;
    StudyProcedure procedure{};  ///< the profile and protocol of the session
    std::string encoding;
    bool codeConfirmed = false;  ///< the participant read the code on their own screen and confirmed it
    bool devicesSimulated = false;
    bool personAnswers = false;  ///< rehearsal: a person answers for a virtual participant
    std::vector<ExclusionAnswer> exclusions;
};

/// A session, or part of a session, that was just begun. The caller creates its file with SessionWriter::create(path,
/// about, clock, seal).
struct BegunSession {
    StudySession session;  ///< the session; its last part is the new part
    std::filesystem::path path;
    std::shared_ptr<const RowSeal> seal;
    std::int64_t ledgerRow = 0;  ///< the last row of the ledger now, for the file's first event (LedgerEnd.h)
    std::string ledgerHead;
};

/// A change of the settings under a committee's amendment of its approval.
struct StudyAmendment {
    std::string reference;
    std::chrono::sys_seconds at{};
    std::vector<std::string> changed;  ///< keys of study.json, such as "cap_ma", "approval.expires"
};

enum class Expectedness { Unknown, Expected, Unexpected };
inline constexpr Word<Expectedness> kExpectedness[] = {
    {"unknown", Expectedness::Unknown}, {"expected", Expectedness::Expected}, {"unexpected", Expectedness::Unexpected}};

struct AdverseEvent {
    std::string what;
    int severity = 1;  ///< one of kEventSeverities
    bool serious = false;
    int relation = 1;  ///< one of kRelations
    std::string action{}, outcome{};
    bool reported = false;
    std::string onset{}, ended{};                   ///< days as 2026-11-21; empty: not known, or not ended
    Expectedness expected = Expectedness::Unknown;  ///< by what the approval says of risks
    std::string releasedBy{}, releasedBecause{};    ///< set by Study::release()
};

/// Data that left the study.
struct StudyExport {
    std::chrono::sys_seconds at{};
    std::string what;   ///< "bids", "study report" or "participant report"
    std::string place;  ///< where the data were written
};

class Study {
public:
    enum class Access { Change, Read };
    /// What tests replace.
    struct Surroundings {
        const SystemTime* time = &SystemTime::real();
        std::filesystem::path keyFolder = defaultKeyFolder();
        PassphraseCost cost = PassphraseCost::moderate();
    };

    /// Returns $XDG_DATA_HOME/tactoscope/keys or ~/.local/share/tactoscope/keys.
    [[nodiscard]] static std::filesystem::path defaultKeyFolder();
    /// Whether `folder` contains a study.
    [[nodiscard]] static bool isThere(const std::filesystem::path& folder);

    /// Creates the study's folder and key file; sets `settings.id` and the approval's protocolSha256. If the passphrase
    /// is lost, the data are lost: callers must say this. Blocks for about a second (Argon2id).
    /// Errors: InvalidArgument for settings that are not accepted and for a weak passphrase; Unsupported for a folder
    /// that is not empty, or that contains the key folder; Io.
    [[nodiscard]] static Result<Study> create(const std::filesystem::path& folder, StudySettings settings,
                                              const Passphrase& passphrase);
    [[nodiscard]] static Result<Study> create(const std::filesystem::path& folder, StudySettings settings,
                                              const Passphrase& passphrase, const Surroundings& surroundings);
    /// Creates a study of virtual participants without a passphrase; its keys lie next to study.json and are not
    /// secret. `settings` may be empty: missing title, approval and consent version are set.
    [[nodiscard]] static Result<Study> createRehearsal(const std::filesystem::path& folder,
                                                       StudySettings settings = {});
    [[nodiscard]] static Result<Study> createRehearsal(const std::filesystem::path& folder, StudySettings settings,
                                                       const Surroundings& surroundings);

    /// If `passphrase` is null, opens without the key, and codes and all sealed data stay hidden; a rehearsal opens
    /// with its key all the same. Errors: NotFound if there is no study, or for a wrong passphrase; Io while another
    /// program has the study open for changing.
    [[nodiscard]] static Result<Study> open(const std::filesystem::path& folder, const Passphrase* passphrase,
                                            Access access);
    [[nodiscard]] static Result<Study> open(const std::filesystem::path& folder, const Passphrase* passphrase,
                                            Access access, const Surroundings& surroundings);
    Study(Study&&) noexcept;
    Study& operator=(Study&&) noexcept;
    ~Study();

    [[nodiscard]] const std::filesystem::path& folder() const noexcept;
    [[nodiscard]] const StudySettings& settings() const noexcept;
    [[nodiscard]] bool isRehearsal() const noexcept;
    [[nodiscard]] bool hasKey() const noexcept;
    /// The file with the study's keys. Who has lost it, or its passphrase, has lost the data.
    [[nodiscard]] std::filesystem::path keyFile() const;
    /// Seals the key file under `next`. Copies of the file still open with the passphrase of their time. Blocks for
    /// about a second. Errors: InvalidArgument for a weak passphrase; as StudyKeys::sealUnder().
    [[nodiscard]] Result<void> changePassphrase(const Passphrase& next);
    /// Hash of the ledger's last row: 64 hexadecimal digits.
    [[nodiscard]] std::string ledgerHead() const;
    /// Returns the basis of such a session's figures: who answers, and whether the devices are simulated.
    [[nodiscard]] static SessionBasis basisOf(const SessionRequest& request, const Participant& who) noexcept;
    /// Returns the same for this participant: for all their sessions, or for the session that they would begin.
    [[nodiscard]] SessionBasis basisOf(const Participant& who) const;
    /// Today's day in UTC, by the clock that dates the ledger's rows.
    [[nodiscard]] CalibrationDate today() const;
    /// Checks the record and approval gates now; called before each block and for the window.
    [[nodiscard]] Result<void> stillApproved() const;

    /// All participants in the order of enrolment, including withdrawn participants.
    [[nodiscard]] std::vector<Participant> participants() const;
    /// Finds a participant by code or "virtual:SEED". Errors: NotFound, also if the code's check character is wrong.
    [[nodiscard]] Result<Participant> find(std::string_view code) const;
    /// The sessions in the order in which they began. Reads their files to set `answered`.
    [[nodiscard]] std::vector<StudySession> sessions() const;
    /// Errors: NotFound.
    [[nodiscard]] Result<StudySession> session(std::string_view id) const;
    /// The participant's unfinished session, if any.
    [[nodiscard]] std::optional<StudySession> unfinished(std::string_view participantId) const;

    /// Says what a change (enrol() to note()) would be refused for, as far as that is known without reading files;
    /// nothing is written. Errors: as `change`.
    [[nodiscard]] Result<void> would(const std::function<Result<void>(Study&)>& change);
    /// Enrols a participant; if `participant.code` is empty, draws a code. Of the other fields, uses only group,
    /// virtualSeed, age, sex and handedness. Errors: kGateRefused if the approved number is already enrolled, or for an
    /// age below the approval's;
    /// InvalidArgument for a code that is taken, and as checkAbout().
    [[nodiscard]] Result<Participant> enrol(Participant participant);
    /// Errors: InvalidArgument for a version of the form that is not in force, or a day on which it was not.
    [[nodiscard]] Result<void> consent(std::string_view code, const Consent& consent);
    /// The participant stops taking part; their data are kept. `reason` may be empty.
    [[nodiscard]] Result<void> leave(std::string_view code, std::string_view reason = {});
    /// Destroys the participant's key: nobody can open their data any more. Errors: kGateRefused if the study keeps
    /// data (data_on_request), and did so when they last consented.
    [[nodiscard]] Result<void> withdraw(std::string_view code);
    /// Changes settings under a committee's amendment. Errors: InvalidArgument for a missing reference or the reference
    /// of an earlier amendment, and for fewer participants than are enrolled.
    [[nodiscard]] Result<void> amend(StudySettings settings, std::string_view reference);
    /// The amendments in their order; available also without the key.
    [[nodiscard]] const std::vector<StudyAmendment>& amendments() const noexcept;
    /// Checks the consent gate for today. Errors: kGateRefused.
    [[nodiscard]] Result<void> consented(const Participant& participant) const;

    /// Returns what goBack() would lose. Errors: kGateRefused if the ledger is the newest known.
    [[nodiscard]] Result<LedgerLoss> lossOfGoingBack() const;
    /// Continues with this ledger and gives up the newer ledger, which then accepts no more changes; a permanent row
    /// records this. Errors: InvalidArgument for any word but LedgerLoss::word(); as lossOfGoingBack().
    [[nodiscard]] Result<void> goBack(std::string_view word);
    /// The records of goBack() in their order; available also without the key.
    [[nodiscard]] const std::vector<StudyGoingBack>& goingsBack() const noexcept;

    /// Records the items answered "yes", sealed for the participant, who is then excluded for the rest of the day
    /// whatever they answer later. Does nothing if every answer is "no", and for a virtual participant.
    [[nodiscard]] Result<void> noteExclusions(const SessionRequest& request);
    /// Checks what is known before the checklist is answered and devices are opened: record, approval, hold,
    /// participant, age, pause since the last session, consent, a yes of today. `again`: an unfinished session would go
    /// on, without the pause. Changes nothing.
    [[nodiscard]] Result<void> mayTakePart(const Participant& participant, bool again) const;
    /// Checks every gate as if no session were unfinished. Changes nothing.
    [[nodiscard]] Result<void> mayBegin(const SessionRequest& request) const;
    /// Checks every gate, then books the session. If a gate refuses, nothing is created.
    [[nodiscard]] Result<BegunSession> beginSession(const SessionRequest& request);
    /// Begins a new part of an unfinished session after the same gates, except for the gap. Errors: NotFound;
    /// kGateRefused for a session that has ended.
    [[nodiscard]] Result<BegunSession> continueSession(std::string_view id, const SessionRequest& request);
    /// Books the end of a session with the chain head of its last file. After Complete or Stopped it never continues.
    [[nodiscard]] Result<void> endSession(std::string_view id, StudySessionState state, std::string_view chainHead);
    /// Ends a session that was just begun but whose bench could not be opened: it does not count for the participant's
    /// number of sessions or for the gap. Not for a session whose file is merely missing.
    [[nodiscard]] Result<void> cancelSession(std::string_view id);
    /// Returns the seal of a part's file. Errors: NotFound for an unknown part; Unsupported if withdrawn or keyless.
    [[nodiscard]] Result<std::shared_ptr<const RowSeal>> sealOf(std::string_view file) const;
    [[nodiscard]] std::filesystem::path pathOf(std::string_view file) const;
    /// Opens the record of a session's part, for resuming, results and exports. Returns nothing if the part's file was
    /// never created. Errors: as sealOf() and SessionReader; ParseError for a file that is not whole or not sealed, or
    /// that is missing or changed since the ledger recorded it.
    [[nodiscard]] Result<std::optional<SessionReader>> part(std::string_view file) const;
    /// Returns the events of all parts of a session, in order. Errors: as part().
    [[nodiscard]] Result<std::vector<SessionRow>> events(const StudySession& session) const;

    /// Records an adverse event, sealed under the study's key, so that it survives a withdrawal. An empty `session`: it
    /// happened outside sessions. Until a serious event is released by name, no session and no block begins.
    [[nodiscard]] Result<void> adverseEvent(std::string_view session, const AdverseEvent& event);
    [[nodiscard]] Result<std::vector<std::pair<std::string, AdverseEvent>>> adverseEvents() const;
    /// Releases the study after the `event`-th adverse event (from 1), which was serious. `by`: the name or initials of
    /// who decided. Errors: NotFound; InvalidArgument without `by`; kGateRefused for an event that holds nothing.
    [[nodiscard]] Result<void> release(std::size_t event, std::string_view by, std::string_view reason);
    /// Number of adverse events; available also without the key.
    [[nodiscard]] std::size_t adverseEventCount() const noexcept;
    /// Records what was said and seen on a day after the session, sealed under the participant's key; the last record
    /// counts. A skin score of 2 or more is also recorded as an adverse event. Errors: NotFound; InvalidArgument as
    /// checkNextDay(); kGateRefused on the day when the session began; Unsupported for a withdrawn participant.
    [[nodiscard]] Result<void> nextDay(std::string_view session, const NextDay& said);
    /// Notes what standards of reporting ask, sealed under the study's key. Errors: as checkNote().
    [[nodiscard]] Result<void> note(const StudyNote& note);
    /// The notes in their order; empty without the key.
    [[nodiscard]] const std::vector<StudyNote>& notes() const noexcept;
    /// Returns nothing if the participant was not asked, or without the key.
    [[nodiscard]] std::optional<NextDay> nextDay(std::string_view session) const;
    /// Returns the seed of the order in which exports label participants. It is derived from the study's key, so that
    /// the study folder alone does not reveal who has which label, and never changes. Errors: Unsupported without the
    /// key.
    [[nodiscard]] Result<std::uint64_t> labelSeed() const;
    /// Number of participants in the first approval, whatever was amended since.
    [[nodiscard]] int firstPlaces() const noexcept;
    /// Records that data were exported to `place`, which is sealed. Errors: InvalidArgument for a place inside the
    /// study folder.
    [[nodiscard]] Result<void> exported(const std::filesystem::path& place, std::string_view what);
    /// The exports in their order; empty without the key.
    [[nodiscard]] std::vector<StudyExport> exports() const;

private:
    struct State;
    explicit Study(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
