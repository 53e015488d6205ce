#include "core/analysis/statistics/Prevalence.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/statistics/Binomial.h"

namespace tacto {

namespace {

/// The share γ for which θ is the probability of a person to be above chance.
double shareOf(double theta) noexcept { return (theta - kAboveChanceLevel) / (1 - kAboveChanceLevel); }

double thetaOf(double share) noexcept { return kAboveChanceLevel + (1 - kAboveChanceLevel) * share; }

/// The quantile `q` of γ.
double shareQuantile(std::size_t k, std::size_t n, double q) noexcept {
    return shareOf(
        truncatedBetaQuantile(static_cast<double>(k + 1), static_cast<double>(n - k + 1), kAboveChanceLevel, q));
}

}  // namespace

Estimate prevalenceInterval(std::size_t k, std::size_t n) noexcept {
    if (n == 0) return {std::numeric_limits<double>::quiet_NaN(), 0, 1};
    constexpr double kLeft = 1 - 0.95;
    const double hits = static_cast<double>(k), misses = static_cast<double>(n - k);
    // The density, which has one maximum, is as high at both ends of the shortest interval, or falls from 0 on.
    const auto rises = [&](double below) {
        const double low = shareQuantile(k, n, below), high = shareQuantile(k, n, below + 1 - kLeft);
        return hits * std::log(thetaOf(low) / thetaOf(high)) + misses * std::log((1 - low) / (1 - high)) < 0;
    };
    double below = 0, above = k == n || !rises(0) ? 0 : kLeft;
    constexpr int kSteps = 60;
    for (int i = 0; i < kSteps && above > 0; ++i) {
        const double middle = below + (above - below) / 2;
        (rises(middle) ? below : above) = middle;
    }
    if (k == n) below = kLeft;
    return {std::max(0.0, shareOf(hits / static_cast<double>(n))), below > 0 ? shareQuantile(k, n, below) : 0,
            k == n ? 1 : shareQuantile(k, n, below + 1 - kLeft)};
}

}  // namespace tacto
