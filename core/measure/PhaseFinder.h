// PhaseFinder.h - excursions from the baseline, each measured by itself. Private to core/measure.
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <vector>

#include "core/measure/FoundPhase.h"
#include "core/measure/SampleBlocks.h"
#include "core/measure/SampleView.h"
#include "core/measure/StateLevels.h"

namespace tacto {

enum class Sides { Both, Up, Down };  ///< above the baseline, below it

/// In time order, everything but the charge. A side on which `levels` has no state has no phases. `view` and `blocks`
/// are of the same samples and must outlive the phases; levels.count is not None.
[[nodiscard]] std::vector<FoundPhase> findPhases(const SampleView& view, const SampleBlocks& blocks,
                                                 const StateLevels& levels, Sides sides);

/// Leaves out what is next to a phase of twenty times its area and shorter and lower than it: the ringing after an
/// edge, and noise on a slow leading edge. In time order.
void dropRinging(std::vector<FoundPhase>& phases);

/// Charge of each phase with its edges: as far as two and a half edge times beyond the 50 % points (half the width
/// where it rings), at most to the middle of the gap towards a neighbour. In time order.
void integratePhases(std::vector<FoundPhase>& phases, const StateLevels& levels);

}  // namespace tacto
