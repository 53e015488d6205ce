// PhaseFinder.h - excursions from the baseline: where they lie, and which were clipped. Private to core/measure.
//
// Thread-safety: pure functions.
#pragma once

#include "core/measure/FoundPhase.h"
#include "core/measure/SampleBlocks.h"
#include "core/measure/SampleView.h"
#include "core/measure/StateLevels.h"

namespace tacto {

enum class Sides { Both, Up, Down };  ///< above the baseline, below it

/// In time order. A side on which `levels` has no state has no phases. `view` and `blocks` are of the same samples and
/// must outlive the phases; levels.count is not None.
[[nodiscard]] PhaseSpans findPhases(const SampleView& view, const SampleBlocks& blocks, const StateLevels& levels,
                                    Sides sides);

}  // namespace tacto
