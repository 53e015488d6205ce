// PhaseFinder.h - excursions from the baseline, each measured by itself. Private to core/measure.
//
// Thread-safety: pure function.
#pragma once

#include <cstddef>
#include <vector>

#include "core/measure/Capture.h"
#include "core/measure/PulseMeasurement.h"
#include "core/measure/StateLevels.h"

namespace tacto {

struct FoundPhase {
    std::size_t begin = 0;  ///< first sample beyond the threshold
    std::size_t end = 0;    ///< one past the last
    int sign = 0;           ///< +1 above the baseline, -1 below
    double area = 0;        ///< sum of its samples' distances from the baseline
    bool truncated = false;
    bool incomplete = false;
    bool clipped = false;
    PhaseMeasurement measured;  ///< filled also where a flag stands: the caller decides what to show
};

/// In time order. Two states: only excursions towards the other state; three: both ways. `channel` has its samples at
/// capture.rate_hz from capture.start_s; levels.count is not None.
[[nodiscard]] std::vector<FoundPhase> findPhases(const Capture& capture, const CaptureChannel& channel,
                                                 const StateLevels& levels);

}  // namespace tacto
