// Origin.h - where the figures of a session come from: marks for each device, in sentences, so that nothing simulated
// or of unknown origin is taken for measured, and nothing that was delivered for simulated (hazard H9).
//
// Thread-safety: pure functions.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/session/SessionTypes.h"

namespace tacto {

class SessionReader;

/// The values of SessionDevice::origin.
namespace origin {
inline constexpr const char* kHardware = "real";
inline constexpr const char* kSimulated = "simulated";
inline constexpr const char* kReplayedMeasured = "replayed, measured";
inline constexpr const char* kReplayedSimulated = "replayed, simulated";
inline constexpr const char* kReplayedUnknown = "replayed, origin not stated";
}  // namespace origin

/// The origin in the session; for one from before it was said, by its mark and its address.
[[nodiscard]] std::string originOf(const SessionDevice& device);

/// The output during a session.
struct Delivered {
    std::uint64_t trains = 0;  ///< trains or vibrations, without impedance checks
    std::uint64_t checks = 0;
    double most = 0;   ///< largest amplitude, in `unit`
    std::string unit;  ///< "V", "mA"; empty for a massager and for a session that does not say
};
/// Counted from the session's commands. Errors: as SessionReader::commands(); Unsupported for one that is locked.
[[nodiscard]] Result<Delivered> deliveredIn(const SessionReader& session);

/// One sentence each. A session with simulated devices only, or one that has none and predicts, is "SIMULATED: ..."; a
/// session of several kinds names each device under its own; one of hardware alone needs none.
[[nodiscard]] std::vector<std::string> originMarks(const SessionAbout& about, const Delivered& delivered);

/// The JSON of `run --json`, by the key "devices".
[[nodiscard]] nlohmann::json devicesJson(const std::vector<SessionDevice>& all);

// Marks for every result of a session: where it comes from, whether the stimulator and R are calibrated, the flags of
// the recording, the known limit of R (science.md section 12).
//
// The bench writes them when it closes. A session without them, of an older program or interrupted, says that they are
// not known: it never reads as one that has none (hazard H9).

/// The mark of a run whose readings make a calibration.
inline constexpr const char* kNotCalibratedBefore = "Before this run the stimulator was not calibrated.";

/// Sentences, and the flags as science.md names them ("uncalibrated R"). Errors: as SessionReader::events() and
/// commands().
[[nodiscard]] Result<std::vector<std::string>> sessionMarks(const SessionReader& session);

}  // namespace tacto
