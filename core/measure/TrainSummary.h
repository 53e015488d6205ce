// TrainSummary.h - from pulses to trains, intervals, statistics and warnings. Private to core/measure.
//
// Thread-safety: pure function.
#pragma once

#include <cstddef>
#include <vector>

#include "core/measure/PulseMeasurement.h"

namespace tacto {

/// A pulse with what grouping needs even when it was flagged and its numbers are gone.
struct FoundPulse {
    PulseMeasurement pulse;
    double approximateOnset_s = 0;
    bool afterBreak = false;  ///< the time since the pulse before it is not known
};

/// Fills `result`'s pulses, trains, statistics, uncertainty and the warnings about pulses. result.states, rate and name
/// are already there.
void summarise(std::vector<FoundPulse> pulses, const CaptureChannel& channel, const MeasureOptions& options,
               ChannelMeasurement& result);

}  // namespace tacto
