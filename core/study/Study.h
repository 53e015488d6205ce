// Study.h - a study: its folder (study.json, ledger.tacto, sessions/), its key file, its participants and sessions.
//
// Promise (hazards H8, H11): what returned a value is on disk. Without the key no code, answer or level can be read:
// those are sealed under keys that lie elsewhere, in the user's key folder. A withdrawn participant's key is destroyed;
// the ledger and the chains stay whole.
//
// One program at a time changes a study; others may read it. A ledger that is not the newest that this computer knows
// (an older copy, one that was cut short or recomputed; LedgerEnd.h) takes no change at all but goBack().
//
// Errors of all calls: NotFound (code), kGateRefused (a gate, Gates.h), Unsupported (a newer Tactoscope made it, or it
// was opened without its key or for reading), ParseError (damaged), Io. Each is one sentence and changes nothing.
//
// Thread-safety: one caller at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
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

/// One file of a session. A crashed session continues in a new one.
struct StudyPart {
    std::string file;  ///< 16 hexadecimal digits: sessions/FILE.tacto
    std::chrono::sys_seconds begun{};
};

struct StudySession {
    std::string id;           ///< 16 hexadecimal digits; the first part's id
    std::string participant;  ///< Participant::id
    std::string code;         ///< empty without the key
    int number = 0;           ///< 1, 2, ... of this participant
    std::string protocol;
    std::string encoding;
    StudySessionState state = StudySessionState::Unfinished;
    SessionBasis basis = SessionBasis::Person;
    bool opened = true;            ///< false where the program noted that its bench could not be opened
    std::vector<StudyPart> parts;  ///< its parts in the order in which they began, at least one
    int answered = 0;              ///< rows "answer" in its files
};

/// The loss when a study continues with a ledger that is not the newest known.
struct LedgerLoss {
    std::int64_t row = 0;             ///< the last row of this ledger ...
    std::chrono::sys_seconds ends{};  ///< ... and when it was written
    std::int64_t newest = 0;          ///< the last that is known; 0: how far it went is not known
    std::string newestHead;
    std::chrono::sys_seconds newestAt{};  ///< 1970 where that is not known
    std::vector<std::string> rows;        ///< names of those that are lost, as far as they are known
    std::vector<std::string> enrolled;    ///< codes that the key file has and this ledger does not
    int keysGone = 0;                     ///< participants of this ledger whose key is not in the key file
    std::vector<std::string> files;       ///< files of sessions that this ledger does not know
    std::vector<std::string> unsealed;    ///< names of rows of this ledger that were not written with the study's key
    int withdrawn = 0;                    ///< participants who withdrew by this ledger, and have a key yet

    /// Rows that are lost; 0: how many is not known.
    [[nodiscard]] std::int64_t lost() const noexcept;
    /// The word that confirms goBack(): "lose-4-rows"; "take-2-rows" where nothing is lost and rows are taken over.
    [[nodiscard]] std::string word() const;
    /// All of it in words, for people.
    [[nodiscard]] std::string sentence() const;
};

/// The request with which a session begins.
struct SessionRequest {
    std::string code;  ///< the code, or "virtual:SEED" for a virtual participant who is enrolled
    ScriptHash script;
    StudyProcedure procedure{};  ///< the profile and protocol that it is run with
    std::string encoding;
    bool codeConfirmed = false;  ///< the participant read the code on their own screen and said that it is theirs
    bool devicesSimulated = false;
    bool personAnswers = false;  ///< in a rehearsal, a person answers for a virtual participant
    std::vector<ExclusionAnswer> exclusions;
};

/// A session, or a part of one, that was just begun. The file does not exist yet: the caller makes it with
/// SessionWriter::create(path, about, clock, seal).
struct BegunSession {
    StudySession session;  ///< the session, with the new part as its last
    std::filesystem::path path;
    std::shared_ptr<const RowSeal> seal;
    std::int64_t ledgerRow = 0;  ///< where the ledger ends now: the file's first event says it (LedgerEnd.h)
    std::string ledgerHead;
};

/// A change of the settings under a committee's amendment.
struct StudyAmendment {
    std::string reference;
    std::chrono::sys_seconds at{};
    std::vector<std::string> changed;  ///< keys of study.json: "cap_ma", "approval.expires"
};

struct AdverseEvent {
    std::string what;
    int severity = 1;  ///< one of kEventSeverities
    bool serious = false;
    int relation = 1;  ///< one of kRelations
    std::string action{}, outcome{};
    bool reported = false;
};

/// Data that left the study.
struct StudyExport {
    std::chrono::sys_seconds at{};
    std::string what;   ///< "bids"; "study report", "participant report"
    std::string place;  ///< the place where they were written
};

class Study {
public:
    enum class Access { Change, Read };
    /// The parts that tests replace.
    struct Surroundings {
        const SystemTime* time = &SystemTime::real();
        std::filesystem::path keyFolder = defaultKeyFolder();
        PassphraseCost cost = PassphraseCost::moderate();
    };

    /// $XDG_DATA_HOME/tactoscope/keys or ~/.local/share/tactoscope/keys.
    [[nodiscard]] static std::filesystem::path defaultKeyFolder();
    /// Whether `folder` holds a study.
    [[nodiscard]] static bool isThere(const std::filesystem::path& folder);

    /// Makes the study's folder and key file; `settings.id` and the approval's protocolSha256 are filled in.
    /// A lost passphrase is lost data: the caller says so. Blocks about a second (Argon2id).
    /// Errors: InvalidArgument for settings that are not accepted; Unsupported for a folder that holds something, or
    /// that the key folder lies in; Io.
    [[nodiscard]] static Result<Study> create(const std::filesystem::path& folder, StudySettings settings,
                                              const Passphrase& passphrase);
    [[nodiscard]] static Result<Study> create(const std::filesystem::path& folder, StudySettings settings,
                                              const Passphrase& passphrase, const Surroundings& surroundings);
    /// A study of virtual participants without a passphrase: its keys lie beside study.json, which says so.
    /// `settings` may be empty: title, approval and consent version are filled in.
    [[nodiscard]] static Result<Study> createRehearsal(const std::filesystem::path& folder,
                                                       StudySettings settings = {});
    [[nodiscard]] static Result<Study> createRehearsal(const std::filesystem::path& folder, StudySettings settings,
                                                       const Surroundings& surroundings);

    /// `passphrase` null: without the key (a rehearsal opens with it all the same); codes and all that is sealed stay
    /// unread then. Errors: NotFound where there is no study, or for a wrong passphrase; Io while another program has
    /// it open for changing.
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
    /// 64 hexadecimal digits.
    [[nodiscard]] std::string ledgerHead() const;
    /// The basis on which the figures of such a session would rest.
    [[nodiscard]] static SessionBasis basisOf(const SessionRequest& request, const Participant& who) noexcept;
    /// The basis of this participant's figures: of all their sessions, or of the one that they would begin.
    [[nodiscard]] SessionBasis basisOf(const Participant& who) const;
    /// Today in UTC, by the clock of the ledger's rows.
    [[nodiscard]] CalibrationDate today() const;
    /// The record and approval gates, now: before each block, and for what the window shows.
    [[nodiscard]] Result<void> stillApproved() const;

    /// All participants in the order of enrolment, withdrawn ones included.
    [[nodiscard]] std::vector<Participant> participants() const;
    /// Finds by code or "virtual:SEED". Errors: NotFound, also for a wrong check character.
    [[nodiscard]] Result<Participant> find(std::string_view code) const;
    /// The sessions in the order in which they began. Reads the sessions' files for `answered`.
    [[nodiscard]] std::vector<StudySession> sessions() const;
    /// Errors: NotFound.
    [[nodiscard]] Result<StudySession> session(std::string_view id) const;
    /// The participant's session that is unfinished, if there is one.
    [[nodiscard]] std::optional<StudySession> unfinished(std::string_view participantId) const;

    /// `participant.code` empty: a new one. Only group, virtualSeed, age, sex and handedness are taken besides.
    /// Errors: kGateRefused when the approval's participants are all enrolled; InvalidArgument for a code that is
    /// taken, and as checkAbout().
    [[nodiscard]] Result<Participant> enrol(Participant participant);
    [[nodiscard]] Result<void> consent(std::string_view code, const Consent& consent);
    /// The participant takes part no longer; the data stay.
    [[nodiscard]] Result<void> leave(std::string_view code);
    /// Destroys the participant's key: nothing of theirs opens any more. Errors: kGateRefused where the study keeps
    /// data (data_on_request), and did when they consented last.
    [[nodiscard]] Result<void> withdraw(std::string_view code);
    /// Changes settings under a committee's amendment. Errors: InvalidArgument without a reference of its own, for one
    /// that an earlier amendment had, and for fewer participants than are enrolled.
    [[nodiscard]] Result<void> amend(StudySettings settings, std::string_view reference);
    /// The amendments in their order; known also without the key.
    [[nodiscard]] const std::vector<StudyAmendment>& amendments() const noexcept;
    /// The consent gate, today. Errors: kGateRefused.
    [[nodiscard]] Result<void> consented(const Participant& participant) const;

    /// The loss that goBack() would cause. Errors: kGateRefused where the ledger is the newest known.
    [[nodiscard]] Result<LedgerLoss> lossOfGoingBack() const;
    /// Continues with this ledger and gives up the newer one, which takes no change any longer; a row of it says so for
    /// ever. Errors: InvalidArgument for any word but the one that names the loss; as lossOfGoingBack().
    [[nodiscard]] Result<void> goBack(std::string_view word);
    /// The goings-back in their order; known also without the key.
    [[nodiscard]] const std::vector<StudyGoingBack>& goingsBack() const noexcept;

    /// The items answered with yes, sealed for the participant; with them their day is over, whatever is answered
    /// later. Nothing where every answer is no, and for a virtual participant.
    [[nodiscard]] Result<void> noteExclusions(const SessionRequest& request);
    /// Whether every gate would let a session begin, were none unfinished. Changes nothing.
    [[nodiscard]] Result<void> mayBegin(const SessionRequest& request) const;
    /// Asks every gate, then books the session. Nothing is made when one refuses.
    [[nodiscard]] Result<BegunSession> beginSession(const SessionRequest& request);
    /// A new part of an unfinished session, with the same gates except for the gap. Errors: NotFound; kGateRefused for
    /// a session that has ended.
    [[nodiscard]] Result<BegunSession> continueSession(std::string_view id, const SessionRequest& request);
    /// Books the end of a session with the chain head of its last file. A complete or stopped one is never continued.
    [[nodiscard]] Result<void> endSession(std::string_view id, StudySessionState state, std::string_view chainHead);
    /// Ends a session that was just begun and whose bench could not be opened: it counts neither as a session of the
    /// participant nor for the gap. A file that is merely gone is not such a session.
    [[nodiscard]] Result<void> cancelSession(std::string_view id);
    /// Opens the file of a part. Errors: NotFound for an unknown part; Unsupported once withdrawn or without key.
    [[nodiscard]] Result<std::shared_ptr<const RowSeal>> sealOf(std::string_view file) const;
    [[nodiscard]] std::filesystem::path pathOf(std::string_view file) const;
    /// The opened record of a part of a session, for resuming, results and exports. Nothing for a part whose file was
    /// never made. Errors: as sealOf() and SessionReader; ParseError for a file that is not whole or not sealed, or has
    /// gone or changed since the ledger noted it.
    [[nodiscard]] Result<std::optional<SessionReader>> part(std::string_view file) const;
    /// The events of all parts of a session, in order. Errors: as part().
    [[nodiscard]] Result<std::vector<SessionRow>> events(const StudySession& session) const;

    /// Stands under the study's key: survives a withdrawal.
    [[nodiscard]] Result<void> adverseEvent(std::string_view session, const AdverseEvent& event);
    [[nodiscard]] Result<std::vector<std::pair<std::string, AdverseEvent>>> adverseEvents() const;
    /// How many there are; known also without the key.
    [[nodiscard]] std::size_t adverseEventCount() const noexcept;
    /// Notes what was said and seen on a day after the session, under the participant's key; the last one counts. Skin
    /// that scores 2 or more is noted as an adverse event, too. Errors: NotFound; InvalidArgument as checkNextDay();
    /// kGateRefused on the day on which the session began; Unsupported for a participant who withdrew.
    [[nodiscard]] Result<void> nextDay(std::string_view session, const NextDay& said);
    /// Nothing where it was not asked, or without the key.
    [[nodiscard]] std::optional<NextDay> nextDay(std::string_view session) const;
    /// Seed of the order in which exports label participants, derived from the study's key so that someone with only
    /// the study folder cannot tell a label's place in the enrolment. The same each time. Errors: Unsupported without
    /// the key.
    [[nodiscard]] Result<std::uint64_t> labelSeed() const;
    /// Participants that the first approval allowed, whatever was amended since.
    [[nodiscard]] int firstPlaces() const noexcept;
    /// Notes that data were exported to `place`, which is sealed. Errors: InvalidArgument for a place inside the study
    /// folder.
    [[nodiscard]] Result<void> exported(const std::filesystem::path& place, std::string_view what);
    /// The exports in the order in which they were made; empty without the key.
    [[nodiscard]] std::vector<StudyExport> exports() const;

private:
    struct State;
    explicit Study(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
