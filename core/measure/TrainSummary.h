// TrainSummary.h - from pulses to trains, intervals, statistics and warnings. Private to core/measure.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/measure/PulseMeasurement.h"

namespace tacto {

/// What is stated of the times that a measurement rests on: half-widths, NaN = not stated.
struct TimeTolerance {
    double base = kNotMeasured;     ///< relative, of the time base
    double stamp_s = kNotMeasured;  ///< how far records are off against each other; 0 within one record
};

/// Fills `result`'s pulses, trains, statistics, uncertainty and the warnings about pulses. result.states, quality, rate
/// and name are already there. `breaks`, ascending: pulses before which an unknown time has passed.
void summarise(std::vector<PulseMeasurement> pulses, std::span<const std::size_t> breaks, const CaptureChannel& channel,
               const TimeTolerance& time, const MeasureOptions& options, ChannelMeasurement& result);

}  // namespace tacto
