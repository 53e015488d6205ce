// FineRange.h - what a second, finer current range shows of the same command: a skin equivalent's charging spike clips
// in it, the end of a phase does not. Private to core/analysis.
//
// Thread-safety: pure functions.
#pragma once

#include <span>

#include "core/analysis/load_safety/LoadFigures.h"

namespace tacto {

/// |Z|, net charge and imbalance of `out`, read again: in `fine`, and in `captures` only while `fine` clips; not
/// measured where a record of the two cannot be read. `figures` are those of `captures`, whose charge and width `out`
/// has.
void addFineRange(LoadReading& out, const LoadFigures& figures, std::span<const Capture> captures,
                  std::span<const Capture> fine, const ExpectedTrain& expected);

}  // namespace tacto
