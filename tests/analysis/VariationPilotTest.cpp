#include <gtest/gtest.h>

#include "core/analysis/VariationPilot.h"

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

TEST(VariationPilot, AboveChanceIsTheExactTest) {
    for (const std::size_t n : {4U, 20U, 80U, 100U}) {
        const auto from = aboveChanceFrom(n, 0.25);
        EXPECT_LE(atLeast(from, n, 0.25), 0.05) << n;
        EXPECT_GT(atLeast(from - 1, n, 0.25), 0.05) << n;
    }
    EXPECT_EQ(aboveChanceFrom(80, 0.25), 27U);  // pilot.md section 7
    EXPECT_EQ(aboveChanceFrom(1, 0.25), 2U) << "one answer is never enough";
}

TEST(VariationPilot, PrevalenceIsThatOfInceAndOthers) {
    EXPECT_NEAR(prevalenceAtLeast(5, 5), 0.59, 0.005);  // pilot.md section 7
    EXPECT_NEAR(prevalenceAtLeast(3, 3), 0.45, 0.005);
    // With k = n, θ^(n+1) is 0.05 of what lies between 0.05^(n+1) and 1.
    for (const std::size_t n : {1U, 4U, 12U}) {
        const double m = static_cast<double>(n + 1), cut = std::pow(0.05, m);
        const double theta = std::pow(cut + 0.05 * (1 - cut), 1 / m);
        EXPECT_NEAR(prevalenceAtLeast(n, n), (theta - 0.05) / 0.95, 1e-10) << n;
    }
    EXPECT_LT(prevalenceAtLeast(4, 5), prevalenceAtLeast(5, 5));
    EXPECT_GE(prevalenceAtLeast(0, 5), 0);
    EXPECT_LT(prevalenceAtLeast(0, 5), 0.02);
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
