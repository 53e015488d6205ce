// Boost.Math in a file of its own: its headers take seconds to compile.
#include "core/analysis/statistics/Binomial.h"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>

#include "core/analysis/statistics/Prevalence.h"

namespace tacto {

namespace {

// Errors as values: no exception leaves a noexcept function.
using QuietBeta =
    boost::math::policies::policy<boost::math::policies::domain_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::evaluation_error<boost::math::policies::ignore_error>,
                                  // Twice as fast as in long double; 1e-14 is more than any number of trials needs.
                                  boost::math::policies::promote_double<false>>;

}  // namespace

double binomialAtLeast(std::size_t k, std::size_t n, double p) noexcept {
    if (k == 0) return 1;
    if (k > n || !(p > 0)) return 0;
    if (p >= 1) return 1;
    return boost::math::ibeta(static_cast<double>(k), static_cast<double>(n - k + 1), p, QuietBeta());
}

std::size_t aboveChanceFrom(std::size_t trials, double chance) noexcept {
    std::size_t low = 0, high = trials + 1;
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (binomialAtLeast(middle, trials, chance) <= kAboveChanceLevel) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
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

}  // namespace tacto
