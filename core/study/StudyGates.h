// StudyGates.h - the gates of a study as its book stands now: record, approval, participant, consent, exclusion. What
// each one asks is in Gates.h.
//
// Errors of all calls: kGateRefused, one sentence; as SessionReader for a ledger that cannot be read.
//
// Thread-safety: as StudyBook.
#pragma once

#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/study/StudyBook.h"

namespace tacto {

class StudyGates {
public:
    /// `book` outlives it.
    explicit StudyGates(const StudyBook& book) noexcept : book_(book) {}

    /// The ledger is the newest known (StudyBook::isNewest()), the chains of the sessions that ended are those that it
    /// noted, and the clock was not set back.
    [[nodiscard]] Result<void> record() const;
    /// Record and approval.
    [[nodiscard]] Result<void> stillApproved() const;
    /// Every gate of a session; `again`: of one that goes on.
    [[nodiscard]] Result<void> session(const SessionRequest& request, Participant participant, bool again) const;

private:
    [[nodiscard]] Result<void> basisGate(const SessionRequest& request, const Participant& participant) const;
    const StudyBook& book_;
};

/// Session files that the ledger does not know, nor gave up when it went back. Errors: Io.
[[nodiscard]] Result<std::vector<std::string>> strangersIn(const StudyFiles& files, const LedgerState& known);

}  // namespace tacto
