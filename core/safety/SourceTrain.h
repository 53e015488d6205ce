// SourceTrain.h - a train in the unit of a source, and the grid of the source that core/encoding rounds it to.
//
// Thread-safety: pure functions.
#pragma once

#include "core/encoding/Rounding.h"
#include "core/safety/SourceTraits.h"

namespace tacto {

/// `shape` at `amplitude`: mA of a current source, V of any other.
[[nodiscard]] inline PulseTrain trainAt(PulseTrain shape, Drive drive, double amplitude) noexcept {
    if (drive == Drive::Current) {
        shape.amplitude = Milliamps(amplitude);
    } else {
        shape.amplitude = Volts(amplitude);
    }
    return shape;
}

[[nodiscard]] inline DeviceGrid gridOf(const SourceTraits& source) noexcept {
    return {.amplitudeStep = source.amplitudeStep,
            .amplitudeMax = source.amplitudeMax,
            .widthStep = source.widthStep,
            .widthMin = source.widthMin,
            .widthMax = source.widthMax,
            .pulsesMax = source.pulsesMax};
}

}  // namespace tacto
