// Include Boost.Math in as few files as possible: its headers take seconds to compile.
#include "core/analysis/statistics/ConfidenceBound.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "core/analysis/statistics/UncertaintyBudget.h"

namespace tacto {

namespace {

// Returns errors as values, because no exception may leave a noexcept function.
using QuietBound =
    boost::math::policies::policy<boost::math::policies::domain_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::evaluation_error<boost::math::policies::ignore_error>>;

constexpr double kOneSided = 0.95;

}  // namespace

double chiSquaredQuantile(double p, double degreesOfFreedom) noexcept {
    if (!(p > 0) || !(p < 1) || !(degreesOfFreedom > 0) || std::isinf(degreesOfFreedom)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    return boost::math::quantile(boost::math::chi_squared_distribution<double, QuietBound>(degreesOfFreedom), p);
}

Bounds variationBounds(double variation, std::size_t n) noexcept {
    if (n < 2 || !std::isfinite(variation)) return {};
    const double freedom = static_cast<double>(n) - 1;
    return {variation * std::sqrt(freedom / chiSquaredQuantile(kOneSided, freedom)),
            variation * std::sqrt(freedom / chiSquaredQuantile(1 - kOneSided, freedom))};
}

Bounds logRatioBounds(const MeanReading& a, const MeanReading& b) noexcept {
    double square = 0, bySquares = 0;
    for (const auto* reading : {&a, &b}) {
        if (reading->n < 2) return {};
        const auto n = static_cast<double>(reading->n);
        const double scatter = reading->sd * reading->sd / n / (reading->mean * reading->mean);
        const double shared = reading->uncertainty / reading->mean;
        square += scatter + shared * shared;
        bySquares += scatter * scatter / (n - 1);
    }
    const double distance = std::abs(std::log(a.mean / b.mean));
    if (!std::isfinite(square) || !std::isfinite(distance)) return {};
    const double freedom = bySquares > 0 ? square * square / bySquares : std::numeric_limits<double>::infinity();
    const double reach = studentQuantile(kOneSided, freedom) * std::sqrt(square);
    return {std::max(0.0, distance - reach), distance + reach};
}

double studentQuantile(double p, double degreesOfFreedom) noexcept {
    if (!(p > 0) || !(p < 1) || !(degreesOfFreedom > 0)) return std::numeric_limits<double>::quiet_NaN();
    if (std::isinf(degreesOfFreedom)) {
        return boost::math::quantile(boost::math::normal_distribution<double, QuietBound>(), p);
    }
    return boost::math::quantile(boost::math::students_t_distribution<double, QuietBound>(degreesOfFreedom), p);
}

}  // namespace tacto
