// BenchCalls.h - what the steps of protocols take from the object "bench".
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

/// Fits `load`: by itself on a simulated bench, else the operator does, asked `request` under the name `question`.
/// Output that is on stays on.
[[nodiscard]] Result<void> changeLoad(ScriptSession& session, const std::string& load, const char* question,
                                      const std::string& request);

/// Sets the members of the profile's encoding section that `changes` has; the others stay. Errors: InvalidArgument for
/// an unknown key or a value outside its range; as Bench::setProfile().
[[nodiscard]] Result<void> changeEncoding(Bench& bench, const Json& changes);

/// The value of bench.devices and bench.calibration.
[[nodiscard]] Json devicesOf(ScriptSession& session);
[[nodiscard]] Result<Json> storedCalibration(ScriptSession& session);

struct KnownLoad {
    double load_ohm;
    double tolerance_pct;     ///< how far the reading may lie from the load, its uncertainty included
    double itsTolerance_pct;  ///< the load's own
};
/// Whether a known load reads as it should, judged and recorded: { load_ohm, measured_ohm, expanded_ohm, deviation_pct,
/// expanded_uncertainty_pct, allowed_pct, verdict, passed, reason }; `reading` is one of measure.pulse(). Errors: Io.
[[nodiscard]] Result<Json> judgeReference(ScriptSession& session, const Json& reading, const KnownLoad& known);
/// bench.readKnownLoad(): arms, reads one train of the strongest command, and judges it. The output stays armed.
[[nodiscard]] Result<Json> knownLoad(ScriptSession& session, double load_ohm, double tolerance_pct);

/// Members of "settings" of a reference source: reference_v, 0 for none, and reference_u_pct.
[[nodiscard]] std::vector<HostParameter> absoluteSettings();
/// The result of bench.readReference(); null where the settings have no source.
[[nodiscard]] Result<Json> absoluteReading(ScriptSession& session, const Arguments& arguments, double tolerance_pct);

struct Sliding {
    std::string material;
    double speed_mm_s = 50;
    double force_n = 1;
};
/// Puts a surface under the finger, or asks for it (question surface-MATERIAL). Errors: InvalidArgument for an unknown
/// surface; NotFound without an answer; Stopped.
[[nodiscard]] Result<void> slide(ScriptSession& session, const Sliding& sliding);

// Oscilloscope records of the trains that come next.

/// How much of a record lies before a train's onset.
inline constexpr double kPreTrigger = 0.15;
/// The time after the last pulse of a train in which the charge runs off.
inline constexpr Seconds kTrainTail{3e-4};

/// A record of one whole train of the bench's encoding and its tail: rate, length and place of the trigger.
[[nodiscard]] ScopeSettings trainRecord(const Bench& bench, Hertz rate);
/// the present |Z|; 1 kΩ until it was measured
[[nodiscard]] Ohms presentLoad(const Telemetry& now) noexcept;

/// How the records are taken. NaN, and 0 samples: as the present command, train and |Z| suggest.
struct CaptureOptions {
    int trains = 1;
    double rate_hz = kNaN;
    std::size_t samples = 0;
    double voltageRange_v = kNaN;
    double currentRange_ma = kNaN;
    double trigger_v = kNaN;
    /// The intervals between the trains are wanted: where the oscilloscope does not state how good the time
    /// stamps of its records are, one record holds them all.
    bool intervals = false;
};
/// Waits for the trains. Errors: Timeout when fewer came; InvalidArgument where intervals are wanted and nothing is
/// driven; as Bench::capture().
[[nodiscard]] Result<std::vector<Capture>> captureTrains(ScriptSession& session, const CaptureOptions& options);

}  // namespace tacto::host::bench
