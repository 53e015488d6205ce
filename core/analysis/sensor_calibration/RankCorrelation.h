// RankCorrelation.h - Spearman's rank correlation with its 95 % interval: do two numbers rank items alike?
//
// ρ is Pearson's correlation of the ranks; equal values share the mean of their ranks. The interval is Fisher's z =
// atanh ρ ± 1.95996 √((1 + ρ²/2) / (n - 3)), with the variance of Bonett and Wright (Psychometrika 65, 2000, 23-28).
// For large |ρ| it is more accurate than Fieller's 1.06 / (n - 3). At |ρ| = 1 the transform is infinite, although five
// surfaces in perfect order prove little. The end towards 0 is then computed at a ρ half-way to the next value that n
// values without ties can have, 1 - 6 / (n (n² - 1)) (a continuity correction, chosen here); the other end is 1.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/Result.h"

namespace tacto {

inline constexpr std::size_t kMinRanked = 5;      ///< with fewer there is no result: the interval is too wide
inline constexpr std::size_t kSmallRanking = 10;  ///< with fewer the interval is approximate, and the result says so

struct RankCorrelation {
    Estimate rho;
    std::size_t n = 0;
    bool ties = false;  ///< true if some values were equal and shared ranks
    std::string note;   ///< a sentence if n is small; else empty
};

/// Errors: InvalidArgument for fewer than kMinRanked pairs, unequal lengths, a value that is not finite, or a list in
/// which all values are equal.
[[nodiscard]] Result<RankCorrelation> spearman(std::span<const double> x, std::span<const double> y);

}  // namespace tacto
