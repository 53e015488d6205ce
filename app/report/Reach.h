// Reach.h - how far a drawing's axis must go.
//
// Thread-safety: a value.
#pragma once

#include <algorithm>
#include <cmath>

#include "app/report/Figure.h"

namespace tacto {

/// The smallest range that holds everything finite it was shown.
struct Reach {
    double low = kUnknown, high = kUnknown;
    void include(double value) {
        if (!std::isfinite(value)) return;
        low = std::fmin(low, value);
        high = std::fmax(high, value);
    }
    [[nodiscard]] bool known() const { return std::isfinite(low); }
    /// 1 where nothing is known.
    [[nodiscard]] double magnitude() const { return known() ? std::max(std::abs(low), std::abs(high)) : 1; }
};

}  // namespace tacto
