// PulseText.h - the result of a pulse into a bench load: as text, as JSON and as a capture.
//
// Thread-safety: pure functions, except print(), which writes to stdout.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/cli/BenchPulse.h"
#include "core/measure/Capture.h"

namespace tacto::cli {

/// Returns "5 mA, 200 us a phase, 100 us between".
[[nodiscard]] std::string describe(const PulseTrain& train);

/// Returns one channel, "voltage_magnitude" or "current_magnitude", that begins at the onset; without a trigger.
[[nodiscard]] Capture captureOf(const sciencemode::SampledPulse& samples, bool simulated);

/// `file`: where the samples were saved; empty: not saved.
[[nodiscard]] nlohmann::json toJson(const BenchPulse& order, const PulseOutcome& outcome, const DeviceIdentity& device,
                                    const std::string& file);
/// Prints a plot of the samples, then the measured values and the verdict.
void print(const BenchPulse& order, const PulseOutcome& outcome, const DeviceIdentity& device, const std::string& file);

}  // namespace tacto::cli
