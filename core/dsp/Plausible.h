// Plausible.h - readings that no fingertip gives: beyond them a value is a fault of its record, however it came there,
// and is left out as NaN is. Impacts stay: they are far below.
//
// Thread-safety: pure functions.
#pragma once

#include <limits>

#include "core/base/Stream.h"

namespace tacto {

/// The largest magnitude that is taken for a reading (science.md section 1).
[[nodiscard]] constexpr double mostPlausible(StreamUnit unit) noexcept {
    switch (unit) {
        case StreamUnit::MetrePerSecondSquared:
            return 5000;
        case StreamUnit::Newton:
            return 200;
        case StreamUnit::Pascal:
            return 10e6;
        case StreamUnit::Count:
            break;
    }
    return std::numeric_limits<double>::max();
}

}  // namespace tacto
