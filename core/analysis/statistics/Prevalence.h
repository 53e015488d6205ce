// Prevalence.h - what k of n people above chance say about everybody: the Bayesian prevalence (Ince et al. 2021,
// doi:10.7554/eLife.62461).
//
// With an even prior, and a test that lets 5 % through who cannot do it, θ = 0.05 + 0.95·γ is Beta(k + 1, n - k + 1)
// between 0.05 and 1, where γ is the share of people who can.
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>

#include "core/analysis/statistics/Estimate.h"

namespace tacto {

/// When `k` of `n` people were above chance: γ at the mode of θ, (k/n - 0.05)/0.95 and at least 0, with the shortest
/// interval that holds 95 %. It begins at 0 where the mode is there, and ends at 1 where k = n: "at least" is its lower
/// end. n = 0 knows nothing: no value, 0 to 1. k ≤ n.
[[nodiscard]] Estimate prevalenceInterval(std::size_t k, std::size_t n) noexcept;

/// The quantile `q` of a Beta(a, b) that is cut off below `from`; a, b ≥ 1, 0 ≤ from < 1, q in 0 to 1.
[[nodiscard]] double truncatedBetaQuantile(double a, double b, double from, double q) noexcept;

}  // namespace tacto
