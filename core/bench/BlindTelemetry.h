// BlindTelemetry.h - what displays may know of a bench while the operator is blind.
//
// Thread-safety: pure functions.
#pragma once

#include "core/bench/Telemetry.h"

namespace tacto {

/// The same for every condition and level (hazard H9): whether the output is armed, paused, off or faulted and why,
/// and the limits that are broken; why without its numbers, which a fault has of the train that it ended. No train,
/// level, reading or age, for each of them comes or changes with a train.
[[nodiscard]] Telemetry blinded(const Telemetry& telemetry);

}  // namespace tacto
