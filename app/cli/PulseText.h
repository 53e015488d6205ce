// PulseText.h - the outcome of a pulse into a bench load: for people, for programs, and as a capture.
//
// Thread-safety: pure functions, but print(), which writes to stdout.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/cli/BenchPulse.h"
#include "core/measure/Capture.h"

namespace tacto::cli {

/// "5 mA, 200 us a phase, 100 us between"
[[nodiscard]] std::string describe(const PulseTrain& train);

/// One channel, "voltage_magnitude" or "current_magnitude", from the onset on; without a trigger.
[[nodiscard]] Capture captureOf(const sciencemode::SampledPulse& samples, bool simulated);

/// `file` is where the samples were saved; empty: nowhere.
[[nodiscard]] nlohmann::json toJson(const BenchPulse& order, const PulseOutcome& outcome, const DeviceIdentity& device,
                                    const std::string& file);
/// The samples drawn, then what they say and the verdict.
void print(const BenchPulse& order, const PulseOutcome& outcome, const DeviceIdentity& device, const std::string& file);

}  // namespace tacto::cli
