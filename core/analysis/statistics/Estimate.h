// Estimate.h - a value with its 95 % interval.
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <limits>

namespace tacto {

/// 95 %. NaN where there is nothing to estimate from.
struct Estimate {
    double value = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();
};

/// Wilson score interval of a proportion. n = 0 knows nothing: no value, 0 to 1. `successes` ≤ n.
[[nodiscard]] Estimate wilsonInterval(std::size_t successes, std::size_t n) noexcept;

}  // namespace tacto
