// TrainSummary.h - computes trains, intervals, statistics and warnings from pulses. Private to core/measure.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/measure/PulseMeasurement.h"

namespace tacto {

/// Stated tolerances of the times of a measurement: half-widths, NaN = not stated.
struct TimeTolerance {
    double base = kNotMeasured;     ///< relative error of the time base
    double stamp_s = kNotMeasured;  ///< error between the stamps of separate records; 0 within one record
};

/// Fills in `result`'s pulses, trains, statistics, uncertainty and warnings about pulses. Its states, quality, rate and
/// name are already set. `breaks`, ascending: pulses before which an unknown time has passed.
void summarise(std::vector<PulseMeasurement> pulses, std::span<const std::size_t> breaks, const CaptureChannel& channel,
               const TimeTolerance& time, const MeasureOptions& options, ChannelMeasurement& result);

}  // namespace tacto
