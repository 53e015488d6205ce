// Clipping.h - which phases lost their tops to the oscilloscope's input range. Private to core/measure.
//
// With a declared range: a sample at or beyond its last step. Without: samples that repeat the record's extreme exactly
// all along a plateau, in a record that otherwise never stays still. Judged on the samples as recorded.
//
// Thread-safety: pure function.
#pragma once

#include "core/measure/FoundPhase.h"
#include "core/measure/SampleBlocks.h"
#include "core/measure/SampleView.h"

namespace tacto {

/// `phases` were found in `view`, whose samples are those of `blocks`.
void markClipped(PhaseSpans& phases, const SampleView& view, const SampleBlocks& blocks);

}  // namespace tacto
