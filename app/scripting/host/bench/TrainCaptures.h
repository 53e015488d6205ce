// TrainCaptures.h - oscilloscope records of the trains that come next, for bench.capture() and the checks on loads.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include <cstddef>
#include <vector>

#include "app/scripting/engine/ScriptSession.h"
#include "core/base/NaN.h"

namespace tacto::host::bench {

/// Trains in one record, where it is to hold their intervals.
inline constexpr int kMinTrainsInOne = 2, kMaxTrainsInOne = 8;

/// How much of a record lies before a train's onset.
inline constexpr double kPreTrigger = 0.15;
/// After the last pulse of a train: the charge runs off.
inline constexpr Seconds kTrainTail{3e-4};

/// A record of one whole train of the bench's encoding and its tail: rate, length and place of the trigger.
[[nodiscard]] ScopeSettings trainRecord(const Bench& bench, Hertz rate);
/// |Z| of now; until it was measured, 1 kΩ.
[[nodiscard]] Ohms presentLoad(const Telemetry& now) noexcept;

/// How the records are taken. NaN, and 0 samples: as the command, the train and |Z| of now suggest.
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
