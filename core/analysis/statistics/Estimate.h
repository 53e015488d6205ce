// Estimate.h - a value with its 95 % interval, and what counts say: k right of n, k of n people above chance.
#pragma once

#include <cstddef>
#include <limits>

namespace tacto {

/// 95 %. NaN where there is nothing to estimate from.
struct Estimate {
    double value = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();
};

/// Wilson score interval of a proportion. n = 0 knows nothing: no value, 0 to 1. `successes` ≤ n.
[[nodiscard]] Estimate wilsonInterval(std::size_t successes, std::size_t n) noexcept;

/// The first count from `low` on that is enough, where every larger one is too; `high` where none below it is.
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

// Exact probabilities and intervals of counts: k right of n.

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

// What k of n people above chance say about everybody: the Bayesian prevalence (Ince et al. 2021,
// doi:10.7554/eLife.62461).
//
// With an even prior, and a test that lets 5 % through who cannot do it, θ = 0.05 + 0.95·γ is Beta(k + 1, n - k + 1)
// between 0.05 and 1, where γ is the share of people who can.

/// When `k` of `n` people were above chance: γ at the mode of θ, (k/n - 0.05)/0.95 and at least 0, with the shortest
/// interval that holds 95 %. It begins at 0 where the mode is 0, and ends at 1 where k = n; its lower end is the "at
/// least". For n = 0 nothing is known: no value, 0 to 1. k ≤ n.
[[nodiscard]] Estimate prevalenceInterval(std::size_t k, std::size_t n) noexcept;

/// The quantile `q` of a Beta(a, b) that is cut off below `from`; a, b ≥ 1, 0 ≤ from < 1, q in 0 to 1.
[[nodiscard]] double truncatedBetaQuantile(double a, double b, double from, double q) noexcept;

}  // namespace tacto
