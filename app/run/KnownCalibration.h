// KnownCalibration.h - the stored calibration of the connected stimulator, for a bench that is about to be made.
//
// A calibration that is missing, expired, damaged or from a simulated bench counts as *not calibrated*; the text says
// why. The gate still judges by the last known calibration, and arms no stimulator that is faulty by it (H1, H9).
//
// Thread-safety: pure but for reading the store.
#pragma once

#include "core/bench/Bench.h"

namespace tacto {

struct KnownCalibration {
    KnownLines calibration;                      ///< the latest calibration, even if expired
    bool holds = false;                          ///< valid today for this device
    std::optional<std::chrono::sys_days> until;  ///< the last day on which the calibration is valid
    std::string text;                            ///< one sentence; empty without a stimulator
};

[[nodiscard]] KnownCalibration knownCalibration(const DeviceSet& devices);

/// Sets the calibration that the bench will apply.
void applyKnown(KnownCalibration known, BenchConfig& config);

}  // namespace tacto
