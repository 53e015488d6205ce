// KnownCalibration.h - what the store knows of the stimulator that is connected, for a bench that is about to be made.
//
// A calibration that is missing, expired, damaged or from a simulated bench counts as *not calibrated*; the text says
// why. The gate judges by the last known one all the same, and arms no stimulator that is out of order by it (H1, H9).
//
// Thread-safety: pure but for reading the store.
#pragma once

#include "core/bench/Bench.h"

namespace tacto {

struct KnownCalibration {
    KnownLines calibration;                      ///< the latest calibration, whatever its date
    bool holds = false;                          ///< today, for this device
    std::optional<std::chrono::sys_days> until;  ///< the last day on which it does
    std::string text;                            ///< one sentence; empty without a stimulator
};

[[nodiscard]] KnownCalibration knownCalibration(const DeviceSet& devices);

/// Has the bench apply it.
void applyKnown(KnownCalibration known, BenchConfig& config);

}  // namespace tacto
