#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/statistics/Binomial.h"
#include "core/analysis/variation/VariationPilot.h"

namespace tacto {
namespace {

/// P(X ≥ k), every outcome counted out.
double atLeast(std::size_t k, std::size_t n, double p) {
    const auto log = [](std::size_t x) { return std::lgamma(static_cast<double>(x) + 1); };
    double sum = 0;
    for (std::size_t i = k; i <= n; ++i) {
        sum += std::exp(log(n) - log(i) - log(n - i) + static_cast<double>(i) * std::log(p) +
                        static_cast<double>(n - i) * std::log1p(-p));
    }
    return sum;
}

TEST(VariationPilot, SomeoneWhoIsNotServedShowsNothing) {
    const double accuracies[] = {0.9, 0.5, 0.3};
    const auto found = outlookOf({accuracies, 6}, 4, 40, 0.25);
    EXPECT_EQ(found.people, 4U);
    EXPECT_EQ(found.rightFrom, aboveChanceFrom(40, 0.25));
    EXPECT_NEAR(found.allServed, std::pow(0.5, 4), 1e-12);
    double one = 0;
    for (const double p : accuracies) one += atLeast(found.rightFrom, 40, p) / 6;
    EXPECT_NEAR(found.allAboveChance, std::pow(one, 4), 1e-10);
    EXPECT_GT(found.width.high, found.width.low);
}

}  // namespace
}  // namespace tacto
