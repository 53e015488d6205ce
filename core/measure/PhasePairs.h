// PhasePairs.h - which phases form a pulse. Private to core/measure.
//
// Thread-safety: pure function.
#pragma once

#include <vector>

#include "core/measure/FoundPhase.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto {

/// Pairs opposite phases at most `gapMax_s` apart where `biphasic`; else each is a pulse. Where a phase could belong to
/// either neighbour, the clearly shorter gap wins: a record may begin between the phases of a pulse. `phases` in time
/// order.
[[nodiscard]] std::vector<PulseMeasurement> pairPhases(const Capture& capture, const std::vector<FoundPhase>& phases,
                                                       bool biphasic, double gapMax_s);

}  // namespace tacto
