// PilotRows.h - the rows of a study session, from all its parts.
//
// Thread-safety: as Study.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pilot/PilotRecord.h"
#include "core/session/SessionTypes.h"
#include "core/study/Study.h"

namespace tacto {

/// How long after the last presentation or answer an interrupted session can be resumed.
inline constexpr std::chrono::hours kResumedWithin{2};

struct PilotRows {
    std::vector<SessionRow> events;         ///< in order of time
    std::optional<std::uint64_t> seed;      ///< the first part's seed
    std::string chainHead;                  ///< the last part's chain head
    std::string language, wordsSha256;      ///< what its participant reads; empty if its plan states none
    std::string runSha256;                  ///< runHash() of its plan; empty if not kept yet
    std::optional<SessionDevice> delivers;  ///< the stimulator or massager of the first part
    /// When something was last presented or answered; else when the session began, even if it was resumed. On a virtual
    /// clock a session's time runs ahead of real time, so the beginning of a part is used. Nothing: a part does not
    /// state when it began.
    std::optional<std::chrono::sys_seconds> answeredAt{};
    std::optional<PilotEnd> ended;  ///< as stated in its row; nothing without such a row

    /// True if the session may continue. A complete session has nothing left to present, however late it is.
    [[nodiscard]] bool mayGoOn(std::chrono::sys_seconds now) const {
        return ended == PilotEnd::Complete || (answeredAt && now - *answeredAt <= kResumedWithin);
    }
};

/// A part that was booked but never made has no rows. Errors: as Study::part().
[[nodiscard]] Result<PilotRows> pilotRows(const Study& study, const StudySession& session);

}  // namespace tacto
