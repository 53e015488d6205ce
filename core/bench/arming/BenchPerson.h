// BenchPerson.h - which devices a participant, human or virtual, may be stimulated with, and what replaces a
// calibration there.
//
// Thread-safety: pure functions.
#pragma once

#include "core/bench/Bench.h"

namespace tacto {

/// Errors: InvalidArgument for a virtual participant on a device, and for a human being on a simulation outside a
/// rehearsal; with one sentence.
[[nodiscard]] Result<void> checkWhere(const BenchConfig& config);

/// In person mode a simulated stimulator of which no calibration is known states its own. Nothing else is changed, and
/// no other device is asked.
[[nodiscard]] BenchConfig withStatedCalibration(BenchConfig config);

}  // namespace tacto
