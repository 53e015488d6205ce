// Waveform.h - a pulse train as samples, charge-exact at any rate.
//
// Each sample is the mean of the ideal rectangular waveform over its own interval [k/fs, (k + 1)/fs), not its value at
// an instant. So the sum of the samples times 1/fs is the exact charge (or flux) of every phase, even where a phase
// does not fall on the sampling grid: an edge inside a sample shows as a partial value there, and a symmetric biphasic
// train sums to zero (to rounding) at any rate.
//
// Thread-safety: pure functions; the caller owns the buffer, nothing allocates.
#pragma once

#include <span>

#include "core/encoding/PulseTrain.h"

namespace tacto {

/// Fills `out` with the train's level in V or A. Sample k covers `start` + [k, k + 1)/sampleRate, time 0 being the
/// leading edge; outside the pulses (gap, rest, before and after) the level is 0. Errors: InvalidArgument as
/// validate(), or for a sampling rate or start that is not finite or not above 0.
[[nodiscard]] Result<void> synthesize(const PulseTrain& train, Hertz sampleRate, std::span<double> out,
                                      Seconds start = Seconds(0));

}  // namespace tacto
