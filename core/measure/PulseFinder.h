// PulseFinder.h - the pulses of one channel: on the record as it is, or without its drift, or on means of its samples,
// whichever shows them reliably. Private to core/measure.
//
// Reliable is a state twelve times the noise away from the baseline (21.6 dB): then no sample of a million is taken for
// a pulse and none of a pulse for silence. A record below that is averaged just so much that it is above, which takes
// resolution in time; each side of a biphasic pulse is averaged by itself, since a slow recharge is shallow and long.
#pragma once

#include <cstddef>
#include <vector>

#include "core/measure/Capture.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto {

struct FoundPulses {
    StateLevels levels;
    std::vector<PulseMeasurement> pulses;  ///< in time order
    SignalQuality quality;
};

[[nodiscard]] FoundPulses findPulses(const Capture& capture, const CaptureChannel& channel,
                                     const MeasureOptions& options);

}  // namespace tacto
