// RankCorrelation.h - Spearman's rank correlation with its 95 % interval: does one number rank as another does?
//
// ρ is Pearson's correlation of the ranks, equal values sharing the mean of their ranks. The interval is Fisher's
// z = atanh ρ ± 1.95996 √((1 + ρ²/2) / (n - 3)), the variance of Bonett and Wright (Psychometrika 65, 2000, 23-28),
// which holds its level better than Fieller's 1.06 / (n - 3) where |ρ| is large.
// At |ρ| = 1 the transform has no end, although five surfaces in perfect order prove little. There the end towards 0 is
// that of the ρ half-way to the next that n values without ties can have, 1 - 6 / (n (n² - 1)) (a continuity
// correction, chosen here); the other end is 1.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/Result.h"

namespace tacto {

inline constexpr std::size_t kMinRanked = 5;      ///< below it nothing is said: the interval spans nearly all
inline constexpr std::size_t kSmallRanking = 10;  ///< below it the interval is approximate, and the result says so

struct RankCorrelation {
    Estimate rho;
    std::size_t n = 0;
    bool ties = false;  ///< some values were equal and shared their ranks
    std::string note;   ///< a sentence where n is small; else empty
};

/// Errors: InvalidArgument for fewer than kMinRanked pairs, unequal lengths, a value that is not finite, or a side
/// on which all values are equal.
[[nodiscard]] Result<RankCorrelation> spearman(std::span<const double> x, std::span<const double> y);

}  // namespace tacto
