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

#include "core/base/Result.h"
#include "core/session/Ledger.h"
#include "core/study/LedgerRows.h"
#include "core/study/Study.h"
#include "core/study/StudyFiles.h"
#include "core/study/StudyKeys.h"
#include "core/study/StudyLock.h"

namespace tacto {

struct StudyBook {
    StudyFiles files;
    Study::Surroundings around;
    StudySettings settings;
    std::optional<StudyLock> lock;
    std::optional<StudyKeys> keys;  ///< nothing without the passphrase
    std::optional<Ledger> ledger;   ///< nothing when opened for reading
    LedgerState known;

    /// As Study::open().
    [[nodiscard]] static Result<StudyBook> open(const std::filesystem::path& folder, const Passphrase* passphrase,
                                                Study::Access access, const Study::Surroundings& around);

    [[nodiscard]] std::chrono::sys_seconds now() const { return around.time->wall(); }
    [[nodiscard]] CalibrationDate today() const;

    /// Takes the keys: a rehearsal's without a passphrase; none for a study without one. Errors: as StudyKeys::open().
    [[nodiscard]] Result<void> unlock(const Passphrase* passphrase);
    /// Takes over what the ledger says. Errors: as replay().
    [[nodiscard]] Result<void> read();
    /// Errors: Unsupported without the key or when opened for reading.
    [[nodiscard]] Result<void> changeable() const;

    /// Appends `body`, with `content` sealed under `key` where there is one.
    [[nodiscard]] Result<void> append(const char* name, nlohmann::json body, const Secret* key = nullptr,
                                      const nlohmann::json& content = {});
    /// The same under a participant's key.
    [[nodiscard]] Result<void> appendOf(const Participant& participant, const char* name, nlohmann::json body,
                                        const nlohmann::json& content);
    /// Errors: Unsupported once the key is destroyed, or without the passphrase.
    [[nodiscard]] Result<const StudyKeys::Entry*> keyOf(std::string_view participant) const;
    /// By code or "virtual:SEED". Errors: as Study::find().
    [[nodiscard]] Result<Participant> find(std::string_view code) const;

    // As those of Study.
    [[nodiscard]] Result<void> amend(StudySettings amended, std::string_view reference);
    [[nodiscard]] Result<void> adverseEvent(std::string_view session, const AdverseEvent& event);
    [[nodiscard]] Result<void> nextDay(std::string_view session, const NextDay& said);
    [[nodiscard]] Result<std::uint64_t> labelSeed() const;

    /// Where this account notes how far the ledger goes (LedgerEnd.h); empty for a rehearsal.
    [[nodiscard]] std::filesystem::path endFile() const;
    [[nodiscard]] Result<std::shared_ptr<const RowSeal>> sealFor(const StudySession& session,
                                                                 std::string_view file) const;
    // As those of Study.
    [[nodiscard]] Result<std::shared_ptr<const RowSeal>> sealOf(std::string_view file) const;
    [[nodiscard]] Result<std::optional<SessionReader>> part(std::string_view file) const;
    /// The session as it stands in the ledger now, with the seal of its last part.
    [[nodiscard]] Result<BegunSession> begun(std::string_view id);
    /// A program was killed between the note of a withdrawal and the end of the key.
    [[nodiscard]] Result<void> finishWithdrawals();
};

/// The day of `at` where the computer stands.
[[nodiscard]] CalibrationDate localDay(std::chrono::sys_seconds at);
/// How far the clock of the computer is ahead of UTC then.
[[nodiscard]] std::chrono::seconds zoneAt(std::chrono::sys_seconds at);
/// The chain head of a session's file; empty for one that was never made, cannot be read or was changed.
[[nodiscard]] std::string headOf(const std::filesystem::path& file);
}  // namespace tacto
