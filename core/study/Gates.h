// Gates.h - what must hold before a session of a study begins (pilot.md section 3) and that the study itself can check:
// record, approval, participant, consent, exclusion. Study::beginSession() checks all gates; no call skips one.
// Machine, skin and electrodes are checked elsewhere (core/pilot/PilotCare.h).
//
// A gate that does not hold returns one sentence, with the value and what would be accepted, as kGateRefused (exit 4).
// NotFound means that the study, code or passphrase cannot be used (exit 3).
//
// Thread-safety: pure functions.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/study/Participant.h"
#include "core/study/StudySettings.h"

namespace tacto {

inline constexpr ErrorCode kGateRefused = ErrorCode::Stopped;

/// Returns text such as "2026-11-23 12:00 UTC".
[[nodiscard]] std::string utcText(std::chrono::sys_seconds at);

/// Returns text such as "2026-11-23 12:00 UTC (2026-11-23 13:00 local time)", rounded up to the minute.
[[nodiscard]] std::string nextText(std::chrono::sys_seconds at);

/// One question of the exclusion checklist. `key` is its name in `--set exclusions=KEY` and in rows.
struct ExclusionItem {
    std::string key;
    std::string question;
    bool operator==(const ExclusionItem&) const = default;
};
/// Returns the program's own items, then the study's, whose keys are "own-1", "own-2".
[[nodiscard]] std::vector<ExclusionItem> exclusionItems(const StudySettings& settings = {});

/// The record that a study continued with a ledger older than the newest known (StudyBook::goBack()).
struct StudyGoingBack {
    std::chrono::sys_seconds at{};
    std::chrono::sys_seconds newestAt{};  ///< when the newest known row was written; 1970 if not known
    std::int64_t lost = 0;                ///< number of lost rows; 0: not known
    std::vector<std::string> rows;        ///< names of the lost rows, as far as known
    std::vector<std::string> files;       ///< session files that were given up, because this ledger does not know them
    std::vector<std::string> unsealed;  ///< names of rows that were taken over though not written with the study's key
};

/// Returns the sentence about it in reports and exports.
[[nodiscard]] std::string goingBackText(const StudyGoingBack& back);

/// A participant's answer of today to one item.
struct ExclusionAnswer {
    std::string key;
    bool yes = false;
};
/// Returns the answer "no" to every item.
[[nodiscard]] std::vector<ExclusionAnswer> nothingExcludes(const StudySettings& settings = {});

/// Every item must be answered "no". The error does not say which answer was "yes": answers are sealed.
[[nodiscard]] Result<void> exclusionGate(std::span<const ExclusionAnswer> answers, const StudySettings& settings = {});

/// Checks that the approval has a reference and includes `today`, and that settings and scripts are as approved.
[[nodiscard]] Result<void> approvalGate(const StudySettings& settings, CalibrationDate today);
/// Checks that `script` is approved.
[[nodiscard]] Result<void> scriptGate(const StudySettings& settings, const ScriptHash& script);
/// Checks that a session's `procedure` is as approved. Rehearsals pass, and so do studies whose approval names no
/// procedure.
[[nodiscard]] Result<void> procedureGate(const StudySettings& settings, const StudyProcedure& procedure);
/// Checks that a stated age is at least the approval's.
[[nodiscard]] Result<void> ageGate(const StudySettings& settings, const Participant& participant);
/// Checks that the participant is active and has had fewer sessions than the approval allows.
[[nodiscard]] Result<void> participantGate(const StudySettings& settings, const Participant& participant);
/// The first moment at which gapGate(), or wentBackGate(), holds.
[[nodiscard]] std::chrono::sys_seconds gapEnd(const StudySettings& settings, std::chrono::sys_seconds lastSession);
[[nodiscard]] std::chrono::sys_seconds wentBackEnd(const StudySettings& settings, const StudyGoingBack& last,
                                                   std::chrono::sys_seconds now);
/// Checks that the last session was long enough ago; rehearsals pass.
[[nodiscard]] Result<void> gapGate(const StudySettings& settings, std::optional<std::chrono::sys_seconds> lastSession,
                                   std::chrono::sys_seconds now);
/// Checks for a consent to the current version of the form, with the initials of who took it, and dated from `since`
/// (the first day of that version's approval) to today.
[[nodiscard]] Result<void> consentGate(const StudySettings& settings, const Participant& participant,
                                       CalibrationDate since, CalibrationDate today);
/// After goBack() a recent session may be lost with the newer ledger: no session may begin on the same day, nor before
/// the approved gap between two sessions has passed. Rehearsals pass.
[[nodiscard]] Result<void> wentBackGate(const StudySettings& settings, std::span<const StudyGoingBack> all,
                                        std::chrono::sys_seconds now);
/// Checks that the clock is at most 5 min behind the last recorded moment, which `of` names.
[[nodiscard]] Result<void> clockGate(std::chrono::sys_seconds last, std::chrono::sys_seconds now,
                                     std::string_view of = "the ledger's last row");
/// A virtual participant, and a rehearsal with electrodes, need simulated devices; a person may use them only in a
/// rehearsal.
[[nodiscard]] Result<void> simulationGate(const StudySettings& settings, const Participant& participant,
                                          bool devicesSimulated);

}  // namespace tacto
