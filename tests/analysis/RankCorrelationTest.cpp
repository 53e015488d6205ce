// Spearman's correlation against scipy 1.10.1 (stats.spearmanr), its interval against numpy with the same formula, and
// against seeded repetitions of known truth.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "core/analysis/RankCorrelation.h"
#include "core/base/Random.h"

namespace tacto {
namespace {

TEST(MidRanks, ShareTheRankOfEqualValues) {
    const std::vector values{0.02, 0.3, 0.25, 0.8, 0.95, 0.95};
    EXPECT_EQ(midRanks(values), (std::vector{1.0, 3.0, 2.0, 4.0, 5.5, 5.5}));  // scipy.stats.rankdata
    EXPECT_EQ((midRanks(std::vector{7.0, 7.0, 7.0})), (std::vector{2.0, 2.0, 2.0}));
}

TEST(Spearman, AgreesWithScipyWhereValuesTie) {
    const auto found =
        spearman(std::vector{1.6, 3.0, 12.0, 24.0, 42.0, 91.0}, std::vector{0.02, 0.3, 0.25, 0.8, 0.95, 0.95}).value();
    EXPECT_NEAR(found.rho.value, 0.9276336570439175, 1e-12);
    EXPECT_NEAR(found.rho.low, 0.2801589617301422, 1e-9);
    EXPECT_NEAR(found.rho.high, 0.994999719260307, 1e-9);
    EXPECT_TRUE(found.ties);
    EXPECT_EQ(found.n, 6U);
    EXPECT_NE(found.note.find("6 surfaces are few"), std::string::npos) << found.note;
}

TEST(Spearman, AgreesWithTheTextbook) {
    // Intelligence against hours of television, the usual worked example: 1 - 6·194 / (10·99) = -29/165.
    const std::vector x{106.0, 100.0, 86.0, 101.0, 99.0, 103.0, 97.0, 113.0, 112.0, 110.0};
    const std::vector y{7.0, 27.0, 2.0, 50.0, 28.0, 29.0, 20.0, 12.0, 6.0, 17.0};
    const auto found = spearman(x, y).value();
    EXPECT_NEAR(found.rho.value, -29.0 / 165, 1e-12);
    EXPECT_NEAR(found.rho.low, -0.7278300282394071, 1e-9);
    EXPECT_NEAR(found.rho.high, 0.5145466616329561, 1e-9);
    EXPECT_FALSE(found.ties);
    EXPECT_TRUE(found.note.empty());
}

TEST(Spearman, OfFiveInPerfectOrderDoesNotClaimCertainty) {
    const std::vector up{1.0, 2.0, 3.0, 4.0, 5.0}, down{5.0, 4.0, 3.0, 2.0, 1.0};
    const auto same = spearman(up, up).value(), turned = spearman(up, down).value();
    EXPECT_EQ(same.rho.value, 1);
    EXPECT_EQ(same.rho.high, 1);
    EXPECT_NEAR(same.rho.low, 0.16080450680271896, 1e-9);  // from ρ = 0.95
    EXPECT_EQ(turned.rho.value, -1);
    EXPECT_EQ(turned.rho.low, -1);
    EXPECT_NEAR(turned.rho.high, -same.rho.low, 1e-12);
}

TEST(Spearman, RefusesWhatCannotBeRanked) {
    RecordProperty("hazard", "H7");
    const std::vector four{1.0, 2.0, 3.0, 4.0}, flat{2.0, 2.0, 2.0, 2.0, 2.0}, five{1.0, 2.0, 3.0, 4.0, 5.0};
    EXPECT_FALSE(spearman(four, four));
    EXPECT_FALSE(spearman(four, five));
    const auto equal = spearman(five, flat);
    ASSERT_FALSE(equal);
    EXPECT_NE(equal.error().message.find("all 5 values of one side are equal"), std::string::npos);
    EXPECT_FALSE((spearman(five, std::vector<double>{1.0, 2.0, NAN, 4.0, 5.0})));
}

class RankCoverage : public ::testing::TestWithParam<std::pair<double, int>> {};

TEST_P(RankCoverage, HoldsTheTruthInAbout95OfA100) {
    // For two normal values of correlation r Spearman's ρ is (6/π) asin(r/2).
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
    EXPECT_LE(share, n < 10 ? 0.99 : 0.97);  // few values: ρ takes few steps, and the interval is the wider one
}

INSTANTIATE_TEST_SUITE_P(Known, RankCoverage,
                         ::testing::Values(std::pair{0.0, 20}, std::pair{0.6, 20}, std::pair{0.9, 20},
                                           std::pair{0.6, 6}, std::pair{0.9, 6}));

}  // namespace
}  // namespace tacto
