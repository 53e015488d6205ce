// ConfidenceBound.h - bounds of a figure, which are compared with a threshold instead of the estimate itself.
//
// Each bound is one-sided (95 %): the true value is above `low` in 95 of 100 cases, and below `high` in 95 of 100.
#pragma once

#include <cstddef>
#include <limits>

namespace tacto {

/// A pair of bounds; NaN if the data are insufficient.
struct Bounds {
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();
};

/// Bounds of a coefficient of variation s/mean from `n` readings: s √((n − 1)/χ²) at the 95 % and 5 % points of χ² with
/// n − 1 degrees of freedom. The mean is assumed to be exact. NaN for n < 2.
[[nodiscard]] Bounds variationBounds(double variation, std::size_t n) noexcept;

/// The mean of one condition's readings.
struct MeanReading {
    double mean = 0;  ///< > 0
    double sd = 0;    ///< standard deviation of single readings
    std::size_t n = 0;
    double uncertainty = 0;  ///< standard uncertainty common to all readings (from the instrument); NaN = unknown
};

/// Bounds of |ln(a.mean / b.mean)|. Its standard error is u² = Σ (s²/n + u_shared²)/mean², with Student's t at the
/// Welch-Satterthwaite degrees of freedom (infinite for u_shared). Errors that both conditions share (a gain, a time
/// base) cancel in the ratio and do not belong in `uncertainty`. `low` is at least 0. NaN for fewer than two readings
/// of a condition or an unknown uncertainty.
[[nodiscard]] Bounds logRatioBounds(const MeanReading& a, const MeanReading& b) noexcept;

/// The p-quantile of χ². `degreesOfFreedom` > 0; NaN unless 0 < p < 1.
[[nodiscard]] double chiSquaredQuantile(double p, double degreesOfFreedom) noexcept;

}  // namespace tacto
