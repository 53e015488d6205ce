// BenchCalls.h - functions of the object "bench" that the steps of protocols use.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptSession.h"
#include "core/base/Statistics.h"

namespace tacto::host::bench {

using Json = nlohmann::json;

/// Fits `load`. A simulated bench does this by itself; otherwise the operator is asked `request`, as question
/// `question`. Output that is on stays on.
[[nodiscard]] Result<void> changeLoad(ScriptSession& session, const std::string& load, const char* question,
                                      const std::string& request);

/// Changes the members in `changes` of the profile's encoding section; the others stay. Errors: InvalidArgument for an
/// unknown key or a value outside its range; as Bench::setProfile().
[[nodiscard]] Result<void> changeEncoding(Bench& bench, const Json& changes);

/// Return the values of bench.devices and bench.calibration.
[[nodiscard]] Json devicesOf(ScriptSession& session);
[[nodiscard]] Result<Json> storedCalibration(ScriptSession& session);

struct KnownLoad {
    double load_ohm;
    double tolerance_pct;     ///< allowed distance of the reading from the load, including its uncertainty
    double itsTolerance_pct;  ///< tolerance of the load itself
};
/// Judges and records whether a known load reads correctly. `reading`: from measure.pulse(). Errors: Io.
[[nodiscard]] Result<Json> judgeReference(ScriptSession& session, const Json& reading, const KnownLoad& known);
/// bench.readKnownLoad(): arms, reads one train of the strongest command, and judges the load. Output stays armed.
[[nodiscard]] Result<Json> knownLoad(ScriptSession& session, double load_ohm, double tolerance_pct);

/// Returns the members of "settings" for a reference source: reference_v (0: no source) and reference_u_pct.
[[nodiscard]] std::vector<HostParameter> absoluteSettings();
/// Returns the result of bench.readReference(), or null if the settings name no source.
[[nodiscard]] Result<Json> absoluteReading(ScriptSession& session, const Arguments& arguments, double tolerance_pct);

struct Sliding {
    std::string material;
    double speed_mm_s = 50;
    double force_n = 1;
};
/// Puts a surface under the finger, or asks the operator to do it (question surface-MATERIAL). Errors: InvalidArgument
/// for an unknown surface; NotFound without an answer; Stopped.
[[nodiscard]] Result<void> slide(ScriptSession& session, const Sliding& sliding);
/// How a finger slides to feel about this R and P, 0 to 1 each: smooth or rough, lightly or firmly.
[[nodiscard]] Sliding slidingFor(double roughness, double pressure);

// Oscilloscope records of the next trains.

/// Share of a record that lies before a train's onset.
inline constexpr double kPreTrigger = 0.15;
/// Time after the last pulse of a train in which the charge decays.
inline constexpr Seconds kTrainTail{3e-4};

/// Returns settings to record one whole train of the bench's encoding and its tail: rate, length and trigger position.
[[nodiscard]] ScopeSettings trainRecord(const Bench& bench, Hertz rate);
/// Returns the present |Z|; 1 kΩ until it has been measured.
[[nodiscard]] Ohms presentLoad(const Telemetry& now) noexcept;

/// Options of a record. NaN, and 0 samples: chosen from the present command, train and |Z|.
struct CaptureOptions {
    int trains = 1;
    double rate_hz = kNaN;
    std::size_t samples = 0;
    double voltageRange_v = kNaN;
    double currentRange_ma = kNaN;
    double trigger_v = kNaN;
    /// True if the intervals between trains are needed. If the oscilloscope does not state the tolerance of its time
    /// stamps, one record then holds all trains.
    bool intervals = false;
};
/// Waits for the trains. Errors: Timeout if too few came; InvalidArgument if intervals are needed but nothing is
/// driven; as Bench::capture().
[[nodiscard]] Result<std::vector<Capture>> captureTrains(ScriptSession& session, const CaptureOptions& options);

}  // namespace tacto::host::bench
