#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/statistics/Prevalence.h"
#include "tests/support/Figures.h"

namespace tacto {
namespace {

TEST(Prevalence, IsThatOfInceAndOthers) {
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
    // With k = 0, (1-θ)^(n+1) is 0.95 of 0.95^(n+1).
    for (const std::size_t n : {1U, 5U, 12U})
        EXPECT_NEAR(prevalenceAtLeast(0, n), 1 - std::pow(0.95, 1 / static_cast<double>(n + 1)), 1e-10) << n;
    EXPECT_LT(prevalenceAtLeast(4, 5), prevalenceAtLeast(5, 5));
}

TEST(Prevalence, IntervalsAreTheShortestThatScipyFinds) {
    // 4 of 5: 38 to 98 %, pilot.md section 7.
    for (const auto& scipy : test::figuresOf("identification").at("prevalence")) {
        const auto found = prevalenceInterval(scipy.at("k"), scipy.at("n"));
        EXPECT_NEAR(found.value, scipy.at("value").get<double>(), 1e-12) << scipy;
        EXPECT_NEAR(found.low, scipy.at("low").get<double>(), 1e-6) << scipy;
        EXPECT_NEAR(found.high, scipy.at("high").get<double>(), 1e-6) << scipy;
    }
    EXPECT_NEAR(prevalenceInterval(5, 5).low, prevalenceAtLeast(5, 5), 1e-12);
}

}  // namespace
}  // namespace tacto
