// Spread.h - how far a value may lie from the one that is expected: what an uncertainty (95 %), a stated accuracy or a
// largest residual amounts to.
//
// Thread-safety: values; pure functions that do not allocate.
#pragma once

#include <algorithm>
#include <cmath>

namespace tacto {

struct Spread {
    double relative = 0;  ///< share of the value: 0.01 is 1 %
    double absolute = 0;  ///< in the value's own unit

    /// The most and the least that a value may be. Zero stays zero: an output that is commanded 0 is off. NaN stays.
    [[nodiscard]] double above(double value) const noexcept {
        return value > 0 ? value * (1 + relative) + absolute : value;
    }
    [[nodiscard]] double below(double value) const noexcept {
        return value > 0 ? std::max(value * (1 - relative) - absolute, 0.0) : value;
    }
    /// 0 or more, finite, and less than the value itself.
    [[nodiscard]] bool sound() const noexcept {
        return relative >= 0 && relative < 1 && absolute >= 0 && std::isfinite(absolute);
    }
    bool operator==(const Spread&) const = default;
};

/// Where none is stated: science.md section 12.
inline constexpr Spread kUnknownSpread{0.05, 0};

}  // namespace tacto
