// Binomial.h - exact probabilities and intervals of counts: k right of n.
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>

#include "core/analysis/statistics/Estimate.h"

namespace tacto {

/// A person is above chance where their right answers have at most this probability by chance, one-sided and exact.
inline constexpr double kAboveChanceLevel = 0.05;

/// P(X ≥ k) for X ~ Binomial(n, p).
[[nodiscard]] double binomialAtLeast(std::size_t k, std::size_t n, double p) noexcept;

/// Fewest right answers of `trials` with P(X ≥ k) ≤ kAboveChanceLevel by chance; trials + 1 where no number is enough.
[[nodiscard]] std::size_t aboveChanceFrom(std::size_t trials, double chance) noexcept;

/// Clopper and Pearson's exact interval of a proportion, which for few trials never promises too much. n = 0 knows
/// nothing: no value, 0 to 1. `successes` ≤ n.
[[nodiscard]] Estimate clopperPearsonInterval(std::size_t successes, std::size_t n) noexcept;

/// a/m - b/n of two independent samples, with Newcombe's hybrid score interval (Stat Med 17, 1998, 873, method 10): the
/// distances to the ends of the two Wilson intervals, squared and added. NaN throughout where m or n is 0.
[[nodiscard]] Estimate newcombeDifference(std::size_t a, std::size_t m, std::size_t b, std::size_t n) noexcept;

}  // namespace tacto
