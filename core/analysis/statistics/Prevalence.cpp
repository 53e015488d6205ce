#include "core/analysis/statistics/Prevalence.h"

#include <algorithm>

#include "core/analysis/statistics/Binomial.h"

namespace tacto {

namespace {

/// The share γ for which θ is the probability of a person to be above chance.
double shareOf(double theta) noexcept { return (theta - kAboveChanceLevel) / (1 - kAboveChanceLevel); }

/// The quantile `q` of γ.
double shareQuantile(std::size_t k, std::size_t n, double q) noexcept {
    return shareOf(
        truncatedBetaQuantile(static_cast<double>(k + 1), static_cast<double>(n - k + 1), kAboveChanceLevel, q));
}

}  // namespace

double prevalenceAtLeast(std::size_t k, std::size_t n) noexcept { return shareQuantile(k, n, 1 - 0.95); }

Estimate prevalenceInterval(std::size_t k, std::size_t n) noexcept {
    if (n == 0) return {std::numeric_limits<double>::quiet_NaN(), 0, 1};
    const double mode = std::max(0.0, shareOf(static_cast<double>(k) / static_cast<double>(n)));
    // The width is convex in the mass below: the density has one maximum.
    double low = 0, high = 1 - 0.95;
    const auto widthFrom = [&](double q) { return shareQuantile(k, n, q + 0.95) - shareQuantile(k, n, q); };
    constexpr int kSteps = 60;
    for (int i = 0; i < kSteps; ++i) {
        const double left = low + (high - low) / 3, right = high - (high - low) / 3;
        (widthFrom(left) <= widthFrom(right) ? high : low) = widthFrom(left) <= widthFrom(right) ? right : left;
    }
    const double q = k == n ? 1 - 0.95 : mode == 0 ? 0 : (low + high) / 2;
    return {mode, shareQuantile(k, n, q), k == n ? 1 : shareQuantile(k, n, q + 0.95)};
}

}  // namespace tacto
