// SurfaceDistance.h - how far apart two surfaces read, in d′: the difference of their means over the pooled standard
// deviation of single slides.
//
// The 95 % interval is exact for normal readings of equal spread: t = d √(n1 n2 / (n1 + n2)) follows the non-central t
// distribution with n1 + n2 - 2 degrees of freedom, so each end is the non-centrality under which t is as extreme as
// 2.5 % (Steiger and Fouladi 1997; Cumming and Finch, Educ. Psychol. Meas. 61, 2001, 532-574).
//
// Two surfaces are told apart when d′ is at least 1 with that confidence, i.e. the interval's end towards 0 is 1 or
// more. d′ = 1 is the customary threshold of detection theory: an unbiased observer who must say which of two slides
// was the rougher is right 76 % of the time, Φ(1/√2) (Green and Swets 1966; Macmillan and Creelman 2005). A reference
// scale is a ratio of small differences below that: it would magnify noise into R.
#pragma once

#include <cstddef>
#include <span>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/Result.h"

namespace tacto {

inline constexpr double kToldApart = 1;       ///< d′
inline constexpr std::size_t kMinSlides = 3;  ///< for each surface

struct SurfaceDistance {
    Estimate d;             ///< second less first, with its sign; the ends may be infinite where nothing scatters
    double difference = 0;  ///< mean of the second less mean of the first
    double pooledSd = 0;
    std::size_t n1 = 0;
    std::size_t n2 = 0;
    /// The end of the interval towards 0 is at least kToldApart, on either side of 0.
    [[nodiscard]] bool toldApart() const noexcept;
    /// |d| and the interval mirrored with it: what a reader is shown. The low end is negative where the sign is open.
    [[nodiscard]] Estimate magnitude() const noexcept;
};

/// Readings that do not scatter at all are infinitely far apart when their means differ, and 0 when they do not.
/// Errors: InvalidArgument for fewer than kMinSlides readings of either, or one that is not finite.
[[nodiscard]] Result<SurfaceDistance> surfaceDistance(std::span<const double> first, std::span<const double> second);

/// P(T ≤ t) of the non-central t distribution. `degreesOfFreedom` ≥ 1. To 1e-6 or better; NaN for arguments that are
/// not finite.
[[nodiscard]] double noncentralT(double t, double degreesOfFreedom, double noncentrality) noexcept;

}  // namespace tacto
