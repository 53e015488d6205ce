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

/// One file of a session. A session that crashed goes on in a new one.
struct StudyPart {
    std::string file;  ///< 16 hexadecimal digits: sessions/FILE.tacto
    std::chrono::sys_seconds begun{};
};

struct StudySession {
    std::string id;           ///< 16 hexadecimal digits; that of its first part
    std::string participant;  ///< Participant::id
    std::string code;         ///< empty without the key
    int number = 0;           ///< 1, 2, ... of this participant
    std::string protocol;
    std::string encoding;
    StudySessionState state = StudySessionState::Unfinished;
    SessionBasis basis = SessionBasis::Person;
    bool opened = true;            ///< false where the program noted that its bench could not be opened
    std::vector<StudyPart> parts;  ///< in the order begun, at least one
    int answered = 0;              ///< rows "answer" in its files
};

/// What going on with a ledger that is not the newest known gives up.
struct LedgerLoss {
    std::int64_t row = 0;             ///< this ledger's last ...
    std::chrono::sys_seconds ends{};  ///< ... and when it was written
    std::int64_t newest = 0;          ///< the last that is known; 0: how far it went is not known
    std::string newestHead;
    std::chrono::sys_seconds newestAt{};  ///< 1970 where that is not known
    std::vector<std::string> rows;        ///< names of those that are lost, as far as they are known
    std::vector<std::string> enrolled;    ///< codes that the key file has and this ledger does not
    int keysGone = 0;                     ///< participants of this ledger whose key is not in the key file
    std::vector<std::string> files;       ///< of sessions that this ledger does not know
    std::vector<std::string> unsealed;    ///< names of rows of this ledger that were not written with the study's key
    int withdrawn = 0;                    ///< participants who withdrew by this ledger, and have a key yet

    /// Rows that are lost; 0: how many is not known.
    [[nodiscard]] std::int64_t lost() const noexcept;
    /// What goBack() is confirmed with: "lose-4-rows"; "take-2-rows" where nothing is lost and rows are taken over.
    [[nodiscard]] std::string word() const;
    /// All of it in words, for people.
    [[nodiscard]] std::string sentence() const;
};

/// What a session is begun with.
struct SessionRequest {
    std::string code;  ///< or "virtual:SEED" of a participant who is enrolled
    ScriptHash script;
    StudyProcedure procedure{};  ///< of the profile and protocol that it is run with
    std::string encoding;
    bool codeConfirmed = false;  ///< the participant read the code on their own screen and said that it is theirs
    bool devicesSimulated = false;
    bool personAnswers = false;  ///< in a rehearsal: for a virtual participant
    std::vector<ExclusionAnswer> exclusions;
};

/// A session, or a part of one, that was just begun. The file does not exist yet: the caller makes it with
/// SessionWriter::create(path, about, clock, seal).
struct BegunSession {
    StudySession session;  ///< with the new part as its last
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
    std::string place;  ///< where they were written
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
    /// On whom and what the figures of such a session would rest.
    [[nodiscard]] static SessionBasis basisOf(const SessionRequest& request, const Participant& who) noexcept;
    /// On whom and what those of this participant rest: all their sessions, or the one that they would begin.
    [[nodiscard]] SessionBasis basisOf(const Participant& who) const;
    /// Today in UTC, by the clock of the ledger's rows.
    [[nodiscard]] CalibrationDate today() const;
    /// The record and approval gates, now: before each block, and for what the window shows.
    [[nodiscard]] Result<void> stillApproved() const;

    /// In the order of enrolment, withdrawn ones among them.
    [[nodiscard]] std::vector<Participant> participants() const;
    /// By code or "virtual:SEED". Errors: NotFound, also for a wrong check character.
    [[nodiscard]] Result<Participant> find(std::string_view code) const;
    /// In the order begun. Reads the sessions' files for `answered`.
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
    /// The participant takes part no more; the data stay.
    [[nodiscard]] Result<void> leave(std::string_view code);
    /// Destroys the participant's key: nothing of theirs opens any more. Errors: kGateRefused where the study keeps
    /// data (data_on_request), and did when they consented last.
    [[nodiscard]] Result<void> withdraw(std::string_view code);
    /// Changes settings under a committee's amendment. Errors: InvalidArgument without a reference of its own, for one
    /// that an earlier amendment had, and for fewer participants than are enrolled.
    [[nodiscard]] Result<void> amend(StudySettings settings, std::string_view reference);
    /// In their order; also without the key.
    [[nodiscard]] const std::vector<StudyAmendment>& amendments() const noexcept;
    /// The consent gate, today. Errors: kGateRefused.
    [[nodiscard]] Result<void> consented(const Participant& participant) const;

    /// What goBack() would give up. Errors: kGateRefused where the ledger is the newest known.
    [[nodiscard]] Result<LedgerLoss> lossOfGoingBack() const;
    /// Goes on with this ledger and gives up the newer one, which takes no change any more; that is a row of it for
    /// ever. Errors: InvalidArgument for another word than that of the loss; as lossOfGoingBack().
    [[nodiscard]] Result<void> goBack(std::string_view word);
    /// In their order; also without the key.
    [[nodiscard]] const std::vector<StudyGoingBack>& goingsBack() const noexcept;

    /// What was answered with yes, sealed for the participant; with it their day is over, whatever is answered later.
    /// Nothing where every answer is no, and for a virtual participant.
    [[nodiscard]] Result<void> noteExclusions(const SessionRequest& request);
    /// Whether every gate would let a session begin, were none unfinished. Nothing is changed.
    [[nodiscard]] Result<void> mayBegin(const SessionRequest& request) const;
    /// Asks every gate, then books the session. Nothing is made when one refuses.
    [[nodiscard]] Result<BegunSession> beginSession(const SessionRequest& request);
    /// A new part of an unfinished session; the same gates, but for the gap. Errors: NotFound; kGateRefused for one
    /// that ended.
    [[nodiscard]] Result<BegunSession> continueSession(std::string_view id, const SessionRequest& request);
    /// Books the end of a session with the chain head of its last file. A complete or stopped one is never continued.
    [[nodiscard]] Result<void> endSession(std::string_view id, StudySessionState state, std::string_view chainHead);
    /// Ends one that was just begun and whose bench could not be opened: it counts neither as a session of the
    /// participant nor for the gap. A file that is merely gone is not one of these.
    [[nodiscard]] Result<void> cancelSession(std::string_view id);
    /// What opens the file of a part. Errors: NotFound for an unknown part; Unsupported once withdrawn or without key.
    [[nodiscard]] Result<std::shared_ptr<const RowSeal>> sealOf(std::string_view file) const;
    [[nodiscard]] std::filesystem::path pathOf(std::string_view file) const;
    /// What a part of a session recorded, opened: what resuming, results and exports go by. Nothing for one whose file
    /// was never made. Errors: as sealOf() and SessionReader; ParseError for one that is not whole or not sealed,
    /// or is gone or another since the ledger noted it.
    [[nodiscard]] Result<std::optional<SessionReader>> part(std::string_view file) const;
    /// The events of all parts of a session, in order. Errors: as part().
    [[nodiscard]] Result<std::vector<SessionRow>> events(const StudySession& session) const;

    /// Under the study's key: survives a withdrawal.
    [[nodiscard]] Result<void> adverseEvent(std::string_view session, const AdverseEvent& event);
    [[nodiscard]] Result<std::vector<std::pair<std::string, AdverseEvent>>> adverseEvents() const;
    /// How many; also without the key.
    [[nodiscard]] std::size_t adverseEventCount() const noexcept;
    /// What was said and seen on a day after the session, under the participant's key; the last one counts. Skin that
    /// scores 2 or more is noted as an adverse event too. Errors: NotFound; InvalidArgument as checkNextDay();
    /// kGateRefused on the day on which the session was begun; Unsupported for a participant who withdrew.
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
    /// In the order made; empty without the key.
    [[nodiscard]] std::vector<StudyExport> exports() const;

private:
    struct State;
    explicit Study(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
