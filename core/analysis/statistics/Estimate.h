// Estimate.h - a value with its 95 % interval, and estimates from counts: k of n answers, k of n people above chance.
#pragma once

#include <cstddef>
#include <limits>

namespace tacto {

/// A value with its 95 % interval; NaN if there are no data.
struct Estimate {
    double value = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();
};

/// Wilson score interval of a proportion. `successes` ≤ n. For n = 0 the value is NaN and the interval 0 to 1.
[[nodiscard]] Estimate wilsonInterval(std::size_t successes, std::size_t n) noexcept;

/// Finds the first count from `low` that is enough (every larger count must be enough, too); `high` if none is.
template <class Enough>
[[nodiscard]] std::size_t firstEnough(std::size_t low, std::size_t high, Enough&& enough) {
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (enough(middle))
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

// Exact probabilities and intervals for counts: k of n answers right.

/// A person is above chance if guessing gives as many right answers with at most this probability, one-sided, exact.
inline constexpr double kAboveChanceLevel = 0.05;

/// P(X ≥ k) for X ~ Binomial(n, p).
[[nodiscard]] double binomialAtLeast(std::size_t k, std::size_t n, double p) noexcept;

/// Smallest k of `trials` with P(X ≥ k) ≤ kAboveChanceLevel by guessing; trials + 1 if no k is enough.
[[nodiscard]] std::size_t aboveChanceFrom(std::size_t trials, double chance) noexcept;

/// Clopper and Pearson's exact interval of a proportion, never too narrow even for few trials; `successes` ≤ n. For n =
/// 0 the value is NaN and the interval 0 to 1.
[[nodiscard]] Estimate clopperPearsonInterval(std::size_t successes, std::size_t n) noexcept;

/// a/m - b/n of two independent samples, with Newcombe's hybrid score interval (Stat Med 17, 1998, 873, method 10):
/// distances to the ends of the two Wilson intervals, combined in quadrature. All NaN if m or n is 0.
[[nodiscard]] Estimate newcombeDifference(std::size_t a, std::size_t m, std::size_t b, std::size_t n) noexcept;

// Bayesian prevalence: what k of n people above chance say about the population (Ince et al. 2021,
// doi:10.7554/eLife.62461).
//
// γ is the share of people who can do the task. Of the others 5 % pass by chance. Therefore θ = 0.05 + 0.95·γ is the
// share who pass. With a uniform prior, θ has a Beta(k + 1, n - k + 1) distribution between 0.05 and 1.

/// Estimates γ if `k` of `n` people (k ≤ n) were above chance: the value at the mode of θ, (k/n - 0.05)/0.95 but at
/// least 0, with the shortest 95 % interval. The interval begins at 0 if the mode is 0, and ends at 1 if k = n. Its low
/// end is the "at least" value. For n = 0 the value is NaN and the interval 0 to 1.
[[nodiscard]] Estimate prevalenceInterval(std::size_t k, std::size_t n) noexcept;

/// Quantile `q` of a Beta(a, b) distribution truncated below `from`; a, b ≥ 1, 0 ≤ from < 1, q in 0 to 1.
[[nodiscard]] double truncatedBetaQuantile(double a, double b, double from, double q) noexcept;

}  // namespace tacto
