// PilotEnding.h - how a pilot session ends, and what ends it for good by the rows that it has.
//
// Thread-safety: constants and pure functions.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tacto {

class PilotRecord;

/// How a session stands when its script has ended.
enum class PilotEnd {
    Unfinished,  ///< interrupted; may be resumed
    Complete,
    Stopped,  ///< ended before its end, for good
};
[[nodiscard]] std::string_view nameOf(PilotEnd end) noexcept;  // "unfinished", "complete", "stopped"
/// Nothing for another word.
[[nodiscard]] std::optional<PilotEnd> pilotEndFrom(std::string_view word) noexcept;

inline constexpr std::size_t kMaxParticipantStops = 3;  ///< the third ends the session (pilot.md section 5)
inline constexpr std::size_t kMaxFaults = 2;            ///< the second ends it

inline constexpr const char* kThirdStop = "the participant stopped for the third time, which ends the session";
inline constexpr const char* kSecondFault = "a second fault ends the session";
/// `level`: "1.5 mA".
[[nodiscard]] std::string tooStrongNow(std::string_view level);

/// What has ended a session for good: the third stop, the second fault, a gate that did not hold, a level of the ramp
/// that is too strong now. A sentence; empty while nothing has. A session that was killed before it ended is not tried
/// again.
[[nodiscard]] std::string endedBy(const PilotRecord& record);

}  // namespace tacto
