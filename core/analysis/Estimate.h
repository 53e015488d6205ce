// Estimate.h - a value with its 95 % interval, and the distances in which people feel differences.
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

/// Smallest relative changes that people notice (science.md section 10).
inline constexpr double kAmplitudeWeberFraction = 0.10;
inline constexpr double kIntervalWeberFraction = 0.16;

/// |ln(x1/x2)| / ln(1 + w) in just-noticeable differences. NaN unless x1, x2 and w are above zero and finite.
[[nodiscard]] double justNoticeableDifferences(double x1, double x2, double weberFraction) noexcept;

}  // namespace tacto
