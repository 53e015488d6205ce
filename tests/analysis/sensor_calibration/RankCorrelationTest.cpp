// Spearman's correlation and its interval, compared with scipy (tests/reference/estimates.py) and with seeded
// repetitions of known truth.
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/analysis/sensor_calibration/RankCorrelation.h"
#include "core/base/Random.h"
#include "tests/support/Figures.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

RankCorrelation expectScipys(const nlohmann::json& scipy) {
    const auto found =
        spearman(scipy.at("x").get<std::vector<double>>(), scipy.at("y").get<std::vector<double>>()).value();
    EXPECT_NEAR(found.rho.value, scipy.at("rho").get<double>(), 1e-12);
    EXPECT_NEAR(found.rho.low, scipy.at("low").get<double>(), 1e-9);
    EXPECT_NEAR(found.rho.high, scipy.at("high").get<double>(), 1e-9);
    return found;
}

TEST(Spearman, AgreesWithScipyWhereValuesTie) {
    const auto found = expectScipys(test::figuresOf("estimates").at("spearman").at("ties"));
    EXPECT_TRUE(found.ties);
    EXPECT_EQ(found.n, 6U);
    EXPECT_NE(found.note.find("6 surfaces are few"), std::string::npos) << found.note;
}

TEST(Spearman, AgreesWithTheTextbook) {
    // The usual worked example, intelligence against hours of television: 1 - 6·194 / (10·99) = -29/165.
    const auto found = expectScipys(test::figuresOf("estimates").at("spearman").at("worked_example"));
    EXPECT_NEAR(found.rho.value, -29.0 / 165, 1e-12);
    EXPECT_FALSE(found.ties);
    EXPECT_TRUE(found.note.empty());
}

TEST(Spearman, OfFiveInPerfectOrderDoesNotClaimCertainty) {
    const std::vector up{1.0, 2.0, 3.0, 4.0, 5.0}, down{5.0, 4.0, 3.0, 2.0, 1.0};
    const auto same = spearman(up, up).value(), turned = spearman(up, down).value();
    EXPECT_EQ(same.rho.value, 1);
    EXPECT_EQ(same.rho.high, 1);
    const auto& nearly = test::figuresOf("estimates").at("spearman").at("nearly_perfect_order");
    EXPECT_NEAR(same.rho.low, nearly.at("low").get<double>(), 1e-9);
    EXPECT_EQ(turned.rho.value, -1);
    EXPECT_EQ(turned.rho.low, -1);
    EXPECT_NEAR(turned.rho.high, -same.rho.low, 1e-12);
}

TEST(Spearman, RefusesWhatCannotBeRanked) {
    RecordProperty("hazard", "H9");
    const std::vector four{1.0, 2.0, 3.0, 4.0}, flat{2.0, 2.0, 2.0, 2.0, 2.0}, five{1.0, 2.0, 3.0, 4.0, 5.0};
    EXPECT_FALSE(spearman(four, four));
    EXPECT_FALSE(spearman(four, five));
    EXPECT_THAT(spearman(five, flat), test::refusedSaying("all 5 values of one side are equal"));
    EXPECT_FALSE((spearman(five, std::vector<double>{1.0, 2.0, NAN, 4.0, 5.0})));
}

class RankCoverage : public ::testing::TestWithParam<std::pair<double, int>> {};

TEST_P(RankCoverage, HoldsTheTruthInAbout95OfA100) {
    // For two normal values with correlation r, Spearman's ρ is (6/π) asin(r/2).
    const auto [r, n] = GetParam();
    const double truth = 6 / std::numbers::pi * std::asin(r / 2);
    constexpr int kRuns = 4000;
    Random random(5, "ranks");
    int covered = 0;
    for (int run = 0; run < kRuns; ++run) {
        std::vector<double> x, y;
        for (int i = 0; i < n; ++i) {
            const double common = random.normal();
            x.push_back(common);
            y.push_back(r * common + std::sqrt(1 - r * r) * random.normal());
        }
        const auto found = spearman(x, y).value();
        covered += found.rho.low <= truth && truth <= found.rho.high ? 1 : 0;
    }
    const double share = static_cast<double>(covered) / kRuns;
    RecordProperty("coverage", std::to_string(share));
    RecordProperty("coverage", std::to_string(share));
    EXPECT_GE(share, 0.93);
    EXPECT_LE(share, n < 10 ? 0.99 : 0.97);  // with few values, ρ takes few steps and the interval is wider
}

INSTANTIATE_TEST_SUITE_P(Known, RankCoverage,
                         ::testing::Values(std::pair{0.0, 20}, std::pair{0.6, 20}, std::pair{0.9, 20},
                                           std::pair{0.6, 6}, std::pair{0.9, 6}));

}  // namespace
}  // namespace tacto
