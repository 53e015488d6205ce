#include "core/analysis/statistics/Estimate.h"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>

namespace tacto {

Estimate wilsonInterval(std::size_t successes, std::size_t n) noexcept {
    if (n == 0) return {std::numeric_limits<double>::quiet_NaN(), 0, 1};
    constexpr double kZ = 1.959963984540054;  // 97.5 % point of the normal distribution
    constexpr double kZ2 = kZ * kZ;
    const double count = static_cast<double>(n);
    const double p = static_cast<double>(successes) / count;
    const double centre = (p + kZ2 / (2 * count)) / (1 + kZ2 / count);
    const double half = kZ / (1 + kZ2 / count) * std::sqrt(p * (1 - p) / count + kZ2 / (4 * count * count));
    return {p, std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

namespace {

// Returns errors as values, because no exception may leave a noexcept function.
using QuietBeta =
    boost::math::policies::policy<boost::math::policies::domain_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::evaluation_error<boost::math::policies::ignore_error>,
                                  // Twice as fast as long double; an accuracy of 1e-14 is enough.
                                  boost::math::policies::promote_double<false>>;

}  // namespace

double binomialAtLeast(std::size_t k, std::size_t n, double p) noexcept {
    if (k == 0) return 1;
    if (k > n || !(p > 0)) return 0;
    if (p >= 1) return 1;
    return boost::math::ibeta(static_cast<double>(k), static_cast<double>(n - k + 1), p, QuietBeta());
}

std::size_t aboveChanceFrom(std::size_t trials, double chance) noexcept {
    return firstEnough(0, trials + 1,
                       [&](std::size_t k) { return binomialAtLeast(k, trials, chance) <= kAboveChanceLevel; });
}

Estimate clopperPearsonInterval(std::size_t successes, std::size_t n) noexcept {
    if (n == 0) return {std::numeric_limits<double>::quiet_NaN(), 0, 1};
    constexpr double kTail = 0.025;
    const double k = static_cast<double>(successes), count = static_cast<double>(n);
    return {k / count, successes == 0 ? 0 : boost::math::ibeta_inv(k, count - k + 1, kTail, QuietBeta()),
            successes == n ? 1 : boost::math::ibeta_inv(k + 1, count - k, 1 - kTail, QuietBeta())};
}

Estimate newcombeDifference(std::size_t a, std::size_t m, std::size_t b, std::size_t n) noexcept {
    if (m == 0 || n == 0) return {};
    const Estimate first = wilsonInterval(a, m), second = wilsonInterval(b, n);
    const double difference = first.value - second.value;
    return {difference, difference - std::hypot(first.value - first.low, second.high - second.value),
            difference + std::hypot(first.high - first.value, second.value - second.low)};
}

double truncatedBetaQuantile(double a, double b, double from, double q) noexcept {
    const double below = boost::math::ibeta(a, b, from, QuietBeta());
    return std::max(from, boost::math::ibeta_inv(a, b, below + q * (1 - below), QuietBeta()));
}

namespace {

/// The share γ at which a person is above chance with probability θ.
double shareOf(double theta) noexcept { return (theta - kAboveChanceLevel) / (1 - kAboveChanceLevel); }

double thetaOf(double share) noexcept { return kAboveChanceLevel + (1 - kAboveChanceLevel) * share; }

/// Quantile `q` of γ.
double shareQuantile(std::size_t k, std::size_t n, double q) noexcept {
    return shareOf(
        truncatedBetaQuantile(static_cast<double>(k + 1), static_cast<double>(n - k + 1), kAboveChanceLevel, q));
}

}  // namespace

Estimate prevalenceInterval(std::size_t k, std::size_t n) noexcept {
    if (n == 0) return {std::numeric_limits<double>::quiet_NaN(), 0, 1};
    constexpr double kLeft = 1 - 0.95;
    const double hits = static_cast<double>(k), misses = static_cast<double>(n - k);
    // The density has a single maximum. It is equal at both ends of the shortest interval, unless it falls from 0 on.
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
