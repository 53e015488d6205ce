// PulseFinder.h - finds the pulses of one channel: on the record itself, without its drift, or on means of its samples,
// whichever shows them reliably. Private to core/measure.
//
// A state is reliable if it is twelve times the noise away from the baseline (21.6 dB). Then fewer than one sample in a
// million is mistaken for a pulse or for silence. A noisier record is averaged just enough to reach this, at a loss of
// time resolution. The sides of a biphasic pulse are averaged separately: a slow recharge is shallow and long.
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
