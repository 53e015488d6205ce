// StripIndex.h - the strips of StripPlots, from top to bottom.
#pragma once

#include <cstddef>

#include "core/base/Stream.h"

namespace tacto::gui {

enum StripIndex : std::size_t { kAcceleration, kForce, kTaxels, kSpectrum, kIndices, kTrains, kStripCount };

/// What a strip of samples shows; the spectrum is the acceleration's.
[[nodiscard]] constexpr StreamKind streamOf(StripIndex strip) noexcept {
    return strip == kForce ? StreamKind::Force : strip == kTaxels ? StreamKind::Taxels : StreamKind::Acceleration;
}

}  // namespace tacto::gui
