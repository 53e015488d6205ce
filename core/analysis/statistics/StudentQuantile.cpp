// Boost.Math in a file of its own: its headers take seconds to compile.
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "core/analysis/statistics/UncertaintyBudget.h"

namespace tacto {

namespace {
// Errors as values: no exception leaves a noexcept function.
using Quiet =
    boost::math::policies::policy<boost::math::policies::domain_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::evaluation_error<boost::math::policies::ignore_error>>;
}  // namespace

double studentQuantile(double p, double degreesOfFreedom) noexcept {
    if (!(p > 0) || !(p < 1) || !(degreesOfFreedom > 0)) return std::numeric_limits<double>::quiet_NaN();
    if (std::isinf(degreesOfFreedom)) {
        return boost::math::quantile(boost::math::normal_distribution<double, Quiet>(), p);
    }
    return boost::math::quantile(boost::math::students_t_distribution<double, Quiet>(degreesOfFreedom), p);
}

}  // namespace tacto
