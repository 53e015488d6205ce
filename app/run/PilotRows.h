// PilotRows.h - the rows of a study's session, from all its parts.
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
    std::vector<SessionRow> events;         ///< in order
    std::optional<std::uint64_t> seed;      ///< the first part's seed
    std::string chainHead;                  ///< the last part's chain head
    std::string runSha256;                  ///< runHash() of its plan; empty where it was not kept yet
    std::optional<SessionDevice> delivers;  ///< the stimulator or massager of the first part
    /// When something was last presented or answered; else when the session began, however often it was resumed. On a
    /// virtual clock a session's time runs ahead of the wall's, so that a part counts from its beginning. Nothing: a
    /// part does not say when it began.
    std::optional<std::chrono::sys_seconds> answeredAt{};
    std::optional<PilotEnd> ended;  ///< as its row says; nothing without such a row

    /// A complete session has nothing left to present, however late it is.
    [[nodiscard]] bool mayGoOn(std::chrono::sys_seconds now) const {
        return ended == PilotEnd::Complete || (answeredAt && now - *answeredAt <= kResumedWithin);
    }
};

/// A part that was booked and never made holds none. Errors: as Study::part().
[[nodiscard]] Result<PilotRows> pilotRows(const Study& study, const StudySession& session);

}  // namespace tacto
