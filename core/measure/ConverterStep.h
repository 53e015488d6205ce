// ConverterStep.h - the step of the converter that a record was made with, found in its samples. Private to
// core/measure.
//
// Samples of a converter lie on a grid: the values that occur are multiples of one step apart. It is seen where noise
// carries the signal to a neighbouring code and back, or where many neighbouring codes occur. Two levels and nothing
// between them (logic, a simulation) say nothing of a step, and neither do samples that lie on no grid (averages,
// filtered records).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/measure/SampleBlocks.h"

namespace tacto {

/// The converter's step in the samples' unit; 0 = none is seen. Looks at some 16 000 samples. Decimal text may have
/// rounded each to a tenth of it.
[[nodiscard]] double converterStep(std::span<const float> samples);

// Single samples that leap from the line their neighbours follow: spikes and dropouts of one sample,
// such as interference or a bad conversion leaves. Private to core/measure.
//
// A sample leaps when it lies beyond what noise and steps of the converter explain, on the same side of both of its
// neighbours, and these and at least one sample further agree with each other: on an edge and in a ringing they do
// not. More than one sample in a hundred is the signal itself.

/// The samples that leap, ascending; empty where they are too many. `noise`: standard deviation from neighbour to
/// neighbour; `lsb` 0 = unknown.
[[nodiscard]] std::vector<std::size_t> leapingSamples(const SampleBlocks& blocks, double noise, double lsb);

/// `view` with the mean of the neighbours in place of each of `leaps`.
[[nodiscard]] SampleView withoutLeaps(const SampleView& view, const std::vector<std::size_t>& leaps);

}  // namespace tacto
