// JustNoticeable.h - distances in just-noticeable differences (science.md section 10).
#pragma once

#include <cmath>
#include <limits>

namespace tacto {

/// The smallest relative changes that people notice.
inline constexpr double kAmplitudeWeberFraction = 0.10;
inline constexpr double kIntervalWeberFraction = 0.16;

/// Returns |ln(x1/x2)| / ln(1 + w), w being `weberFraction`. NaN unless x1, x2 and w are above zero and finite.
[[nodiscard]] inline double justNoticeableDifferences(double x1, double x2, double weberFraction) noexcept {
    const auto usable = [](double x) { return x > 0 && std::isfinite(x); };
    if (!usable(x1) || !usable(x2) || !usable(weberFraction)) return std::numeric_limits<double>::quiet_NaN();
    return std::abs(std::log(x1 / x2)) / std::log1p(weberFraction);
}

}  // namespace tacto
