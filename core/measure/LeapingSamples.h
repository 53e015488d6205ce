// LeapingSamples.h - single samples that leap from the line their neighbours follow: spikes and dropouts of one sample,
// such as interference or a bad conversion leaves. Private to core/measure.
//
// A sample leaps when it lies beyond what noise and steps of the converter explain, on the same side of both of its
// neighbours, and these and at least one sample further agree with each other: on an edge and in a ringing they do
// not. More than one sample in a hundred is the signal itself.
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <vector>

#include "core/measure/SampleBlocks.h"
#include "core/measure/SampleView.h"

namespace tacto {

/// Where samples leap, ascending; empty where they are too many. `noise`: standard deviation from neighbour to
/// neighbour; `lsb` 0 = unknown.
[[nodiscard]] std::vector<std::size_t> leapingSamples(const SampleBlocks& blocks, double noise, double lsb);

/// `view` with the mean of the neighbours in place of each of `leaps`.
[[nodiscard]] SampleView withoutLeaps(const SampleView& view, const std::vector<std::size_t>& leaps);

}  // namespace tacto
