// Boost.Math in a file of its own: its headers take seconds to compile.
#include <algorithm>
#include <boost/math/special_functions/beta.hpp>

#include "core/analysis/variation/VariationTrials.h"

namespace tacto {

namespace {
// Errors as values: no exception leaves a noexcept function.
using Quiet =
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
    return boost::math::ibeta(static_cast<double>(k), static_cast<double>(n - k + 1), p, Quiet());
}

double truncatedBetaQuantile(double a, double b, double from, double q) noexcept {
    const double below = boost::math::ibeta(a, b, from, Quiet());
    return std::max(from, boost::math::ibeta_inv(a, b, below + q * (1 - below), Quiet()));
}

}  // namespace tacto
