// ConfidenceBound.h - how far a figure may lie from its estimate: what a threshold is judged against in place of the
// estimate itself.
//
// Each bound is one-sided, 95 %: the true value lies above `low` in 95 of 100 cases, and below `high` in 95 of 100.
#pragma once

#include <cstddef>
#include <limits>

namespace tacto {

/// NaN where there is nothing to tell them from.
struct Bounds {
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();
};

/// Bounds of a coefficient of variation s/mean from `n` readings: (n − 1) s²/σ² follows χ² with n − 1 degrees of
/// freedom, so the ends are s √((n − 1)/χ²) at its 95 % and 5 % points; the mean is taken as known. NaN for n < 2.
[[nodiscard]] Bounds variationBounds(double variation, std::size_t n) noexcept;

/// The mean of one condition's readings.
struct MeanReading {
    double mean = 0;  ///< > 0
    double sd = 0;    ///< standard deviation of single readings
    std::size_t n = 0;
    double uncertainty = 0;  ///< standard uncertainty that all its readings share (the instrument's); NaN = unknown
};

/// Bounds of |ln(a.mean / b.mean)|: its standard error by the law of propagation, u² = Σ (s²/n + u_shared²)/mean², and
/// Student's t at the Welch-Satterthwaite degrees of freedom, u_shared with infinitely many. What the two conditions
/// share as well (a gain, a time base) divides out of the ratio: it is not part of `uncertainty`. `low` is at least 0.
/// NaN for fewer than two readings of either, or where an uncertainty is unknown.
[[nodiscard]] Bounds logRatioBounds(const MeanReading& a, const MeanReading& b) noexcept;

/// The p-quantile of χ²; `degreesOfFreedom` > 0; 0 < p < 1, otherwise NaN.
[[nodiscard]] double chiSquaredQuantile(double p, double degreesOfFreedom) noexcept;

}  // namespace tacto
