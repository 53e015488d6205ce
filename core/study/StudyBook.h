// StudyBook.h - an open study: its files, its keys, and what its ledger says now. What Study is made of.
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
    std::optional<StudyKeys> keys;  ///< none without the passphrase
    std::optional<Ledger> ledger;   ///< none when opened for reading
    LedgerState known;

    /// As Study::open().
    [[nodiscard]] static Result<StudyBook> open(const std::filesystem::path& folder, const Passphrase* passphrase,
                                                Study::Access access, const Study::Surroundings& around);

    [[nodiscard]] std::chrono::sys_seconds now() const { return around.time->wall(); }
    /// Today in UTC; never before the day of the ledger's last row.
    [[nodiscard]] CalibrationDate today() const;

    /// Takes the keys: a rehearsal's without a passphrase; none for a study without one. Errors: as StudyKeys::open().
    [[nodiscard]] Result<void> unlock(const Passphrase* passphrase);
    /// Takes over what the ledger says. Errors: as replay().
    [[nodiscard]] Result<void> read();
    /// Errors: Unsupported without the key or when opened for reading; as isNewest().
    [[nodiscard]] Result<void> changeable() const;
    /// The ledger is the newest that this computer knows of: it goes as far as is noted beside the keys, in the key
    /// file and in each session, and knows every session's file. Errors: kGateRefused, naming the way back.
    [[nodiscard]] Result<void> isNewest() const;
    /// The loss where it is not the newest. Errors: as isNewest() where it is; Unsupported as changeable().
    [[nodiscard]] Result<LedgerLoss> lossOfGoingBack() const;
    [[nodiscard]] Result<void> goBack(std::string_view word);

    /// Appends `body`, with `content` sealed under `key` where there is one. Errors: as changeable().
    [[nodiscard]] Result<void> append(const char* name, nlohmann::json body, const Secret* key = nullptr,
                                      const nlohmann::json& content = {});
    /// Writes it, whatever the ledger's end is.
    [[nodiscard]] Result<void> write(const char* name, nlohmann::json body, const Secret* key = nullptr,
                                     const nlohmann::json& content = {});
    /// Appends like append(), under a participant's key.
    [[nodiscard]] Result<void> appendOf(const Participant& participant, const char* name, nlohmann::json body,
                                        const nlohmann::json& content);
    /// Errors: Unsupported once the key is destroyed, or without the passphrase.
    [[nodiscard]] Result<const StudyKeys::Entry*> keyOf(std::string_view participant) const;
    /// Finds by code or "virtual:SEED". Errors: as Study::find().
    [[nodiscard]] Result<Participant> find(std::string_view code) const;

    // Does what Study::amend() does.
    [[nodiscard]] Result<void> amend(StudySettings amended, std::string_view reference);
    [[nodiscard]] Result<void> adverseEvent(std::string_view session, const AdverseEvent& event);
    [[nodiscard]] Result<void> nextDay(std::string_view session, const NextDay& said);
    [[nodiscard]] Result<std::uint64_t> labelSeed() const;

    /// The first day that a consent to this version of the form counts from: of one that was never in force, the first
    /// approval's.
    [[nodiscard]] CalibrationDate formSince(std::string_view version) const;
    /// Asks the consent gate for today.
    [[nodiscard]] Result<void> consented(const Participant& participant) const;
    /// The file in which this account notes how far the ledger goes (LedgerEnd.h), and the one that copies of the study
    /// hold while they are changed; both empty for a rehearsal.
    [[nodiscard]] std::filesystem::path endFile() const;
    [[nodiscard]] std::filesystem::path keysLock() const;
    [[nodiscard]] LedgerEnd end() const;
    [[nodiscard]] Result<std::shared_ptr<const RowSeal>> sealFor(const StudySession& session,
                                                                 std::string_view file) const;
    // Does what Study::sealOf() does.
    [[nodiscard]] Result<std::shared_ptr<const RowSeal>> sealOf(std::string_view file) const;
    [[nodiscard]] Result<std::optional<SessionReader>> part(std::string_view file) const;
    /// The session as it stands in the ledger now, with the seal of its last part.
    [[nodiscard]] Result<BegunSession> begun(std::string_view id);
    /// Notes beside the keys and in them how far the ledger goes.
    void noteEnd();
    /// A program was killed between the note of a withdrawal and the end of the key.
    [[nodiscard]] Result<void> finishWithdrawals();
};

/// The day of `at` in UTC: days of a study are in UTC, whatever zone the computer is set to.
[[nodiscard]] CalibrationDate utcDay(std::chrono::sys_seconds at);
/// The chain head of a session's file; empty for one that was never made, cannot be read or was changed.
[[nodiscard]] std::string headOf(const std::filesystem::path& file);

// The gates of a study as its book stands now: record, approval, participant, consent, exclusion. What each one asks is
// in Gates.h.
//
// Errors of all calls: kGateRefused, one sentence; as SessionReader for a ledger that cannot be read.

class StudyGates {
public:
    /// `book` outlives it.
    explicit StudyGates(const StudyBook& book) noexcept : book_(book) {}

    /// The ledger is the newest known (StudyBook::isNewest()), the chains of the sessions that ended are those that it
    /// noted, and the clock was not set back.
    [[nodiscard]] Result<void> record() const;
    /// Record and approval.
    [[nodiscard]] Result<void> stillApproved() const;
    /// Asks every gate of a session; `again`: of one that is resumed.
    [[nodiscard]] Result<void> session(const SessionRequest& request, Participant participant, bool again) const;

private:
    [[nodiscard]] Result<void> basisGate(const SessionRequest& request, const Participant& participant) const;
    const StudyBook& book_;
};

/// Session files that the ledger does not know, nor gave up when it went back. Errors: Io.
[[nodiscard]] Result<std::vector<std::string>> strangersIn(const StudyFiles& files, const LedgerState& known);

}  // namespace tacto
