// Gates.h - what must hold before a session of a study begins (pilot.md section 3), as far as the study itself can
// tell: record, approval, participant, consent, exclusion. Study::beginSession() asks all of them; no call leaves one
// out. The machine, the skin and the electrode are asked where they are known.
//
// A gate that does not hold is one sentence with the value and what would be accepted, under kGateRefused (exit 4).
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

/// "2026-11-23 12:00 UTC".
[[nodiscard]] std::string utcText(std::chrono::sys_seconds at);

/// One question of the exclusion checklist. `key` is what `--set exclusions=KEY` and rows say.
struct ExclusionItem {
    std::string_view key;
    std::string_view question;
};
[[nodiscard]] std::span<const ExclusionItem> exclusionItems() noexcept;

/// A resumption with a ledger older than one that this computer knows (StudyBook::goBack()).
struct StudyGoingBack {
    std::chrono::sys_seconds at{};
    std::chrono::sys_seconds newestAt{};  ///< when the newest known row was written; 1970 where that is not known
    std::int64_t lost = 0;                ///< rows; 0: how many is not known
    std::vector<std::string> rows;        ///< the names of the rows, as far as they are known
    std::vector<std::string> files;       ///< files of sessions that it does not know: given up
    std::vector<std::string> unsealed;  ///< names of rows that were taken over and that the study's key had not written
};

/// The sentence about it for reports and readers of an export.
[[nodiscard]] std::string goingBackText(const StudyGoingBack& back);

/// An answer that the participant gave today.
struct ExclusionAnswer {
    std::string key;
    bool yes = false;
};
/// Answers that exclude nothing: every item with no.
[[nodiscard]] std::vector<ExclusionAnswer> nothingExcludes();

/// Every item must be answered, and with no. The sentence never says which answer was yes: that is sealed.
[[nodiscard]] Result<void> exclusionGate(std::span<const ExclusionAnswer> answers);

/// The reference is there, `today` lies within the approval, and the settings and scripts are those approved.
[[nodiscard]] Result<void> approvalGate(const StudySettings& settings, CalibrationDate today);
/// `script` is one of those approved.
[[nodiscard]] Result<void> scriptGate(const StudySettings& settings, const ScriptHash& script);
/// A session's `procedure` must be the approved one. A rehearsal does not ask, nor does a study whose approval names no
/// procedure.
[[nodiscard]] Result<void> procedureGate(const StudySettings& settings, const StudyProcedure& procedure);
/// Whether they are active, and had fewer sessions than the approval allows.
[[nodiscard]] Result<void> participantGate(const StudySettings& settings, const Participant& participant);
/// The last session lies far enough back; a rehearsal does not ask.
[[nodiscard]] Result<void> gapGate(const StudySettings& settings, std::optional<std::chrono::sys_seconds> lastSession,
                                   std::chrono::sys_seconds now);
/// A consent to the version in force, dated no later than today and no earlier than `since`, the first day on which the
/// form's version was approved, with the initials of who took it.
[[nodiscard]] Result<void> consentGate(const StudySettings& settings, const Participant& participant,
                                       CalibrationDate since, CalibrationDate today);
/// A ledger that went back may have lost a session from a moment ago: as long as two sessions lie apart none begins,
/// nor on the same day. A rehearsal does not ask.
[[nodiscard]] Result<void> wentBackGate(const StudySettings& settings, std::span<const StudyGoingBack> all,
                                        std::chrono::sys_seconds now);
/// The clock is not more than 5 min behind the last noted moment, which `of` names.
[[nodiscard]] Result<void> clockGate(std::chrono::sys_seconds last, std::chrono::sys_seconds now,
                                     std::string_view of = "the ledger's last row");
/// A virtual participant, and a rehearsal with electrodes, on simulated devices only; a person on a simulated one in a
/// rehearsal only.
[[nodiscard]] Result<void> simulationGate(const StudySettings& settings, const Participant& participant,
                                          bool devicesSimulated);

}  // namespace tacto
