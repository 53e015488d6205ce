// Origin.h - the origin of a session's figures: sentences that mark each device, so that nobody takes simulated figures
// or figures of unknown origin for measurements, or a real output for a simulation (hazard H9).
//
// Thread-safety: pure functions.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
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

/// The device's stated origin; an older session states none, and the device's simulation mark and address then decide.
[[nodiscard]] std::string originOf(const SessionDevice& device);

/// The output during a session.
struct Delivered {
    std::uint64_t trains = 0;  ///< trains or vibrations, without impedance checks
    std::uint64_t checks = 0;
    double most = 0;   ///< largest amplitude, in `unit`
    std::string unit;  ///< "V" or "mA"; empty for a massager, or if the session does not say
};
/// Counts the commands of a session, and calls `also` for each train delivered: one pass serves both. Errors: as
/// SessionReader::commands(); Unsupported for a locked session.
[[nodiscard]] Result<Delivered> deliveredIn(const SessionReader& session,
                                            const std::function<void(const SessionRow&)>& also = {});

/// Returns one sentence for each mark. A session with simulated devices only, or without devices but with predictions,
/// is marked "SIMULATED: ..."; in a mixed session each device has its own mark; real devices alone need no mark.
[[nodiscard]] std::vector<std::string> originMarks(const SessionAbout& about, const Delivered& delivered);

/// Returns the value of the key "devices" in the JSON of `run --json`.
[[nodiscard]] nlohmann::json devicesJson(const std::vector<SessionDevice>& all);

// The marks for all results of a session: where they come from, whether the stimulator and R are calibrated, the flags
// of the recording, and the known limit of R (science.md section 12).
//
// The bench writes the marks when it closes. A session without them (interrupted, or from an older program) says that
// its marks are not known: it is never shown as a session that has no marks (hazard H9).

/// The mark of a run whose readings become a calibration.
inline constexpr const char* kNotCalibratedBefore = "Before this run the stimulator was not calibrated.";

/// What the benches of a session recorded about its marks.
struct RecordedMarks {
    std::vector<std::string> flags;  ///< by their names in science.md: "uncalibrated R"
    bool complete = false;           ///< whether a bench closed and wrote them
    std::optional<bool> stimulatorCalibrated;
    std::string measuredBeyond;          ///< the first such text; empty: none
    std::vector<double> uncertaintyOfR;  ///< U (expanded uncertainty, 95 %) at R = 0, 0.5 and 1; empty: not known
};
[[nodiscard]] RecordedMarks recordedMarks(const std::vector<SessionRow>& events);

/// Returns the marks as sentences, and the flags by their names in science.md ("uncalibrated R"). Errors: as
/// SessionReader::events() and commands().
[[nodiscard]] Result<std::vector<std::string>> sessionMarks(const SessionReader& session);
[[nodiscard]] Result<std::vector<std::string>> sessionMarks(const SessionReader& session, const Delivered& delivered);

}  // namespace tacto
