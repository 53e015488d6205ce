// EarlierThresholds.h - thresholds and range of a session of `pilot-thresholds`, and whether a session that begins now
// may take them over (pilot.md section 4): at most half an hour later, electrodes or massager untouched, the same
// device, and an impedance within 30 %. Levels are reached again by a ramp, as on a resume; that is the caller's.
//
// Thread-safety: values; pure functions.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/base/NaN.h"
#include "core/base/Result.h"
#include "core/session/SessionTypes.h"
#include "core/study/Study.h"

namespace tacto {

inline constexpr std::chrono::minutes kThresholdsHold{30};

struct EarlierThresholds {
    std::chrono::sys_seconds endedAt{};  ///< when its last row was written, by the wall clock
    std::string device, serial;          ///< name and serial number of the stimulator or massager
    LevelUnit unit = LevelUnit::Current;
    double detection = kNaN;            ///< in `unit`, as the next three
    double min = kNaN, max = kNaN;      ///< the range
    std::optional<double> tooStrong{};  ///< lowest level called so; nothing: none was
    double impedance_ohm = kNaN;        ///< when the range was found; NaN with a massager
};

/// What is asked and measured at the session that would take them over.
struct ThresholdsNow {
    std::chrono::sys_seconds at{};  ///< wall clock
    std::string device, serial;
    LevelUnit unit = LevelUnit::Current;
    bool untouched = false;       ///< the operator says so of the electrodes, or of the massager
    double impedance_ohm = kNaN;  ///< not asked with a massager
};

/// The session in which `participant` (Participant::id) last took part, where it may have thresholds to take over.
/// Errors: NotFound where there is none, or it was of another protocol, or did not come to its end.
[[nodiscard]] Result<StudySession> thresholdsSession(const std::vector<StudySession>& sessions,
                                                     std::string_view participant);
/// What the events of all its parts say; `endedAt`, `device` and `serial` are left to the caller.
/// Errors: NotFound naming what is missing: a usable range, a threshold, an impedance, the session's end.
[[nodiscard]] Result<EarlierThresholds> earlierThresholds(const std::vector<SessionRow>& events, LevelUnit unit);
/// Errors: kGateRefused with the value and what would be accepted.
[[nodiscard]] Result<void> stillHold(const EarlierThresholds& found, const ThresholdsNow& now);

}  // namespace tacto
