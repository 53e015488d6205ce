// StatesCalibration.h - a stimulator that knows its own calibration, because it is simulated. The bench believes no
// other.
//
// Thread-safety: statedCalibration() is constant while the device is open.
#pragma once

#include "core/encoding/StimulatorCalibration.h"

namespace tacto {

/// Implemented beside Stimulator.
class StatesCalibration {
public:
    virtual ~StatesCalibration() = default;
    /// Nothing where it does not know: it is out of order on purpose.
    [[nodiscard]] virtual const KnownLines& statedCalibration() const noexcept = 0;
};

}  // namespace tacto
