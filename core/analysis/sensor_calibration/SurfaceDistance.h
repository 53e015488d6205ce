// SurfaceDistance.h - the distance of two surfaces in d′: difference of their means / pooled standard deviation of
// single slides.
//
// The 95 % interval is exact for normal readings with equal spread: t = d √(n1 n2 / (n1 + n2)) follows the non-central
// t distribution with n1 + n2 - 2 degrees of freedom. At each end, the non-centrality puts t at the outer 2.5 %
// (Steiger and Fouladi 1997; Cumming and Finch, Educ. Psychol. Meas. 61, 2001, 532-574).
//
// Two surfaces are told apart if d′ is at least 1 with 95 % confidence: the interval's end towards 0 is 1 or more. A d′
// of 1 is the usual threshold of detection theory: an unbiased observer who must say which of two slides was rougher is
// right in 76 % of trials, Φ(1/√2) (Green and Swets 1966; Macmillan and Creelman 2005). With less, the reference scale
// would be a ratio of small differences and would turn noise into changes of R.
#pragma once

#include <cstddef>
#include <span>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/Result.h"

namespace tacto {

inline constexpr double kToldApart = 1;       ///< smallest d′ that tells two surfaces apart
inline constexpr std::size_t kMinSlides = 3;  ///< smallest number for each surface

struct SurfaceDistance {
    Estimate d;             ///< second minus first, with sign; the ends may be infinite without scatter
    double difference = 0;  ///< mean of the second minus mean of the first
    double pooledSd = 0;
    std::size_t n1 = 0;
    std::size_t n2 = 0;
    /// True if the end of the interval towards 0 is at least kToldApart in magnitude.
    [[nodiscard]] bool toldApart() const noexcept;
    /// |d| with its interval, mirrored if d is negative, for display. The low end is negative if the sign is uncertain.
    [[nodiscard]] Estimate magnitude() const noexcept;
};

/// Readings without any scatter are infinitely far apart if their means differ; otherwise the distance is 0. Errors:
/// InvalidArgument for fewer than kMinSlides readings of a surface, or a reading that is not finite.
[[nodiscard]] Result<SurfaceDistance> surfaceDistance(std::span<const double> first, std::span<const double> second);

/// P(T ≤ t) of the non-central t distribution, to 1e-6 or better. `degreesOfFreedom` ≥ 1. NaN for arguments that are
/// not finite.
[[nodiscard]] double noncentralT(double t, double degreesOfFreedom, double noncentrality) noexcept;

}  // namespace tacto
