#include <gtest/gtest.h>

#include "core/analysis/variation/VariationPilot.h"
#include "tests/support/Figures.h"

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
    // 27 of 80, as science.md section 11 says; 2 of 1: one answer is never enough.
    for (const auto& scipy : test::figuresOf("estimates").at("above_chance"))
        EXPECT_EQ(aboveChanceFrom(scipy.at("n"), scipy.at("chance")), scipy.at("from").get<std::size_t>()) << scipy;
}

TEST(VariationPilot, PrevalenceIsThatOfInceAndOthers) {
    // 5 of 5 and 3 of 3, which science.md section 11 rounds to 59 and 45 %.
    for (const auto& scipy : test::figuresOf("estimates").at("prevalence")) {
        EXPECT_NEAR(prevalenceAtLeast(scipy.at("k"), scipy.at("n")), scipy.at("at_least").get<double>(), 1e-9) << scipy;
    }
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
