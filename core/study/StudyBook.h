// StudyBook.h - an open study: its files, its keys and the present state of its ledger. A part of Study.
//
// Thread-safety: one caller at a time.
#pragma once

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/session/Ledger.h"
#include "core/study/LedgerEnd.h"
#include "core/study/LedgerRows.h"
#include "core/study/Study.h"
#include "core/study/StudyFiles.h"
#include "core/study/StudyKeys.h"

namespace tacto {

struct StudyBook {
    StudyFiles files;
    Study::Surroundings around;
    StudySettings settings;
    std::optional<StudyLock> lock;
    std::optional<StudyKeys> keys;  ///< not set without the passphrase
    std::optional<Ledger> ledger;   ///< none if opened for reading
    LedgerState known;
    std::optional<bool> tried{};  ///< set: nothing is written (Study::would()); true once every check has passed

    /// Does what Study::open() does.
    [[nodiscard]] static Result<StudyBook> open(const std::filesystem::path& folder, const Passphrase* passphrase,
                                                Study::Access access, const Study::Surroundings& around);

    /// Checks that a day in a text, if it is one, is not later than today. Errors: InvalidArgument naming `what`.
    [[nodiscard]] Result<void> notInTheFuture(std::string_view what, std::string_view day) const;
    [[nodiscard]] std::chrono::sys_seconds now() const { return around.time->wall(); }
    /// Today in UTC, but never before the day of the ledger's last row.
    [[nodiscard]] CalibrationDate today() const;

    /// Opens the keys: a rehearsal needs no passphrase; without one, a study has none. Errors: as StudyKeys::open().
    [[nodiscard]] Result<void> unlock(const Passphrase* passphrase);
    /// Reads the state from the ledger. Errors: as replay().
    [[nodiscard]] Result<void> read();
    /// Checks that changes are possible. Errors: Unsupported without the key or if opened for reading; as isNewest().
    [[nodiscard]] Result<void> changeable() const;
    /// Called before each write: ends a change that is only tried. Errors: Stopped if it is.
    [[nodiscard]] Result<void> mayWrite();
    /// Checks that the ledger is the newest that this computer knows of: it contains the ends noted next to the keys,
    /// in the key file and in each session, and every session's file. Errors: kGateRefused, naming the way back.
    [[nodiscard]] Result<void> isNewest() const;
    /// The loss if the ledger is not the newest. Errors: kGateRefused if it is the newest; Unsupported as changeable().
    [[nodiscard]] Result<LedgerLoss> lossOfGoingBack() const;
    [[nodiscard]] Result<void> goBack(std::string_view word);

    /// Appends `body`; if there is a `key`, with `content` sealed under it. Errors: as changeable().
    [[nodiscard]] Result<void> append(const char* name, nlohmann::json body, const Secret* key = nullptr,
                                      const nlohmann::json& content = {});
    /// Appends like append(), but without checking the ledger's end.
    [[nodiscard]] Result<void> write(const char* name, nlohmann::json body, const Secret* key = nullptr,
                                     const nlohmann::json& content = {});
    /// Appends like append(), with `content` sealed under the participant's key.
    [[nodiscard]] Result<void> appendOf(const Participant& participant, const char* name, nlohmann::json body,
                                        const nlohmann::json& content);
    /// Errors: Unsupported if the key was destroyed, or without the passphrase.
    [[nodiscard]] Result<const StudyKeys::Entry*> keyOf(std::string_view participant) const;
    /// Finds a participant by code or "virtual:SEED". Errors: as Study::find().
    [[nodiscard]] Result<Participant> find(std::string_view code) const;

    // Does what Study::amend() does.
    [[nodiscard]] Result<void> amend(StudySettings amended, std::string_view reference);
    [[nodiscard]] Result<void> adverseEvent(std::string_view session, const AdverseEvent& event);
    [[nodiscard]] Result<void> nextDay(std::string_view session, const NextDay& said);
    [[nodiscard]] Result<std::uint64_t> labelSeed() const;

    /// Returns the first day from which a consent to this version of the form is valid. For a version that was never in
    /// force, returns the first day of the first approval.
    [[nodiscard]] CalibrationDate formSince(std::string_view version) const;
    /// Checks the consent gate for today.
    [[nodiscard]] Result<void> consented(const Participant& participant) const;
    /// endFile(): the file in which this account notes the ledger's end (LedgerEnd.h). keysLock(): the file that locks
    /// all copies of the study during a change. Both are empty for a rehearsal.
    [[nodiscard]] std::filesystem::path endFile() const;
    [[nodiscard]] std::filesystem::path keysLock() const;
    [[nodiscard]] LedgerEnd end() const;
    [[nodiscard]] Result<std::shared_ptr<const RowSeal>> sealFor(const StudySession& session,
                                                                 std::string_view file) const;
    // Does what Study::sealOf() does.
    [[nodiscard]] Result<std::shared_ptr<const RowSeal>> sealOf(std::string_view file) const;
    [[nodiscard]] Result<std::optional<SessionReader>> part(std::string_view file) const;
    /// Returns the session as the ledger has it now, with the seal of the session's last part.
    [[nodiscard]] Result<BegunSession> begun(std::string_view id);
    /// Notes the ledger's end next to the keys and in the key file.
    void noteEnd();
    /// Destroys keys that remain because the program was killed after it recorded a withdrawal.
    [[nodiscard]] Result<void> finishWithdrawals();
};

/// Whether the event holds the study: it is serious and was not released by name.
[[nodiscard]] bool holdsStudy(const AdverseEvent& event) noexcept;
/// Returns the day of `at` in UTC; days of a study are UTC days, whatever the computer's time zone.
[[nodiscard]] CalibrationDate utcDay(std::chrono::sys_seconds at);
/// Returns the chain head of a session's file; empty for a file that is missing, unreadable or changed.
[[nodiscard]] std::string headOf(const std::filesystem::path& file);

// Checks the gates of a study in its present state: record, approval, participant, consent, exclusion. Gates.h defines
// the single gates.
//
// Errors of all calls: kGateRefused, one sentence; as SessionReader for a ledger that cannot be read.

class StudyGates {
public:
    /// `book` must outlive this object.
    explicit StudyGates(const StudyBook& book) noexcept : book_(book) {}

    /// Checks that the ledger is the newest known (StudyBook::isNewest()), that ended sessions have the chain heads
    /// recorded in the ledger, and that the clock was not set back.
    [[nodiscard]] Result<void> record() const;
    /// Checks the record and approval gates.
    [[nodiscard]] Result<void> stillApproved() const;
    /// Checks every gate of a session that is known before its checklist is answered; `again`: it is resumed.
    [[nodiscard]] Result<void> beforehand(Participant participant, bool again) const;
    /// Checks every gate of a session, those of beforehand() first.
    [[nodiscard]] Result<void> session(const SessionRequest& request, const Participant& participant, bool again) const;

private:
    /// Checks that no serious event holds the study. Rehearsals pass.
    [[nodiscard]] Result<void> eventGate() const;
    /// Adds to a refusal that waiting ends when the next session of this participant is possible.
    [[nodiscard]] Result<void> untilWhen(Result<void> holds, const Participant& participant,
                                         std::optional<std::chrono::sys_seconds> last) const;
    [[nodiscard]] Result<void> basisGate(const SessionRequest& request, const Participant& participant) const;
    const StudyBook& book_;
};

/// Session files that the ledger neither knows nor gave up in goBack(). Errors: Io.
[[nodiscard]] Result<std::vector<std::string>> strangersIn(const StudyFiles& files, const LedgerState& known);

}  // namespace tacto
