// CaptureClock.h - how well an oscilloscope's clock is known: its time base and its time stamps, as standard
// uncertainties of what the capture states (science.md section 12). Unknown is NaN and never 0.
//
// Thread-safety: pure functions.
#pragma once

#include <cmath>

#include "core/measure/Capture.h"

namespace tacto::host::measure {

/// Standard uncertainty of the time base, relative. NaN = not stated.
[[nodiscard]] inline double timeBaseUncertainty(const Capture& capture) noexcept {
    return capture.timeBaseTolerance / std::sqrt(3.0);
}

/// Standard uncertainty of a record's time stamp against those of other records, s. NaN = not stated.
[[nodiscard]] inline double stampUncertainty_s(const Capture& capture) noexcept {
    return capture.stampTolerance_s / std::sqrt(3.0);
}

}  // namespace tacto::host::measure
