// ConverterStep.h - finds the step of the converter from the samples of a record. Private to core/measure.
//
// Samples of a converter lie on a grid: all values are multiples of one step apart. The step shows if noise moves the
// signal to a neighbouring code and back, or if many neighbouring codes occur. Two levels with nothing between them
// (logic, a simulation) do not show a step, and neither do samples off any grid (averages, filtered records).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/measure/SampleBlocks.h"

namespace tacto {

/// Returns the converter's step in the samples' unit; 0 = no step found. Looks at about 16 000 samples. Each may be
/// rounded, as in decimal text, to a tenth of the step.
[[nodiscard]] double converterStep(std::span<const float> samples);

// Finds single samples that leap from the line through their neighbours: spikes and dropouts of one sample, caused by
// interference or a bad conversion. Private to core/measure.
//
// A sample leaps if it lies on the same side of both neighbours, further away than noise and converter steps explain,
// and if these two and at least one more sample agree with each other. On an edge and in ringing they do not agree. If
// more than one sample in a hundred leaps, the leaps are the signal itself.

/// Returns the samples that leap, in ascending order, or none if there are too many. `noise`: standard deviation
/// between neighbours; `lsb` 0 = unknown.
[[nodiscard]] std::vector<std::size_t> leapingSamples(const SampleBlocks& blocks, double noise, double lsb);

/// Returns `view` with each sample in `leaps` replaced by the mean of its neighbours.
[[nodiscard]] SampleView withoutLeaps(const SampleView& view, const std::vector<std::size_t>& leaps);

}  // namespace tacto
