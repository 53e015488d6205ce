// d' and its interval against scipy 1.10.1 (stats.nct and optimize.brentq), and against seeded repetitions of known
// truth.
#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/SurfaceDistance.h"
#include "core/base/Random.h"

namespace tacto {
namespace {

TEST(NoncentralT, AgreesWithScipy) {
    struct {
        double t, nu, delta, p;
    } const known[] = {{2.0, 4, 1.0, 0.7645674538243243},
                       {10, 8, 9, 0.5892129653913103},
                       {-1.5, 5, 0.7, 0.025959718000640394},
                       {50, 8, 45, 0.5934424889877222},
                       {3, 18, 0, 0.9961572939298429}};
    for (const auto& [t, nu, delta, p] : known) EXPECT_NEAR(noncentralT(t, nu, delta), p, 1e-6) << t;
    EXPECT_TRUE(std::isnan(noncentralT(NAN, 4, 1)));
    EXPECT_TRUE(std::isnan(noncentralT(1, 0.5, 1)));
}

TEST(SurfaceDistance, AgreesWithScipy) {
    const auto far =
        surfaceDistance(std::vector{1.1, 1.4, 0.9, 1.2, 1.3}, std::vector{2.0, 2.3, 1.8, 2.2, 2.6}).value();
    EXPECT_NEAR(far.pooledSd, 0.2539685019840059, 1e-12);
    EXPECT_NEAR(far.d.value, 3.93749615479079, 1e-10);
    EXPECT_NEAR(far.d.low, 1.6421009851847919, 1e-6);
    EXPECT_NEAR(far.d.high, 6.166534823871678, 1e-6);
    EXPECT_TRUE(far.toldApart());
    const auto near = surfaceDistance(std::vector{1.0, 1.2, 0.8, 1.1}, std::vector{1.1, 1.3, 0.9, 1.0, 1.25}).value();
    EXPECT_NEAR(near.d.value, 0.5034965460952296, 1e-10);
    EXPECT_NEAR(near.d.low, -0.8534245247335361, 1e-5);
    EXPECT_NEAR(near.d.high, 1.8265585779304674, 1e-5);
    EXPECT_FALSE(near.toldApart());
}

TEST(SurfaceDistance, IsTheSameSeenFromTheOtherSide) {
    const std::vector a{1.1, 1.4, 0.9, 1.2}, b{2.0, 2.3, 1.8};
    const auto there = surfaceDistance(a, b).value(), back = surfaceDistance(b, a).value();
    EXPECT_NEAR(back.d.value, -there.d.value, 1e-12);
    EXPECT_NEAR(back.magnitude().low, there.magnitude().low, 1e-6);
    EXPECT_NEAR(back.magnitude().high, there.magnitude().high, 1e-6);
    EXPECT_EQ(back.toldApart(), there.toldApart());
}

TEST(SurfaceDistance, OfReadingsThatDoNotScatterIsInfiniteOrNothing) {
    const auto apart = surfaceDistance(std::vector{1.0, 1.0, 1.0}, std::vector{2.0, 2.0, 2.0}).value();
    EXPECT_TRUE(std::isinf(apart.d.value));
    EXPECT_TRUE(apart.toldApart());
    const auto same = surfaceDistance(std::vector{1.0, 1.0, 1.0}, std::vector{1.0, 1.0, 1.0}).value();
    EXPECT_EQ(same.d.value, 0);
    EXPECT_FALSE(same.toldApart());
}

TEST(SurfaceDistance, RefusesTooFewSlidesAndNan) {
    RecordProperty("hazard", "H7");
    const auto few = surfaceDistance(std::vector{1.0, 2.0}, std::vector{1.0, 2.0, 3.0});
    ASSERT_FALSE(few);
    EXPECT_NE(few.error().message.find("2 slides of one; at least 3"), std::string::npos) << few.error().message;
    EXPECT_FALSE((surfaceDistance(std::vector<double>{1.0, NAN, 2.0}, std::vector{1.0, 2.0, 3.0})));
}

struct Truth {
    double delta;
    int n;
};
class DistanceCoverage : public ::testing::TestWithParam<Truth> {};

TEST_P(DistanceCoverage, HoldsTheTruthIn95OfA100) {
    const auto [delta, n] = GetParam();
    constexpr int kRuns = 1000;
    Random random(7, "surface distance");
    int covered = 0;
    for (int run = 0; run < kRuns; ++run) {
        std::vector<double> a, b;
        for (int i = 0; i < n; ++i) {
            a.push_back(random.normal());
            b.push_back(delta + random.normal());
        }
        const auto found = surfaceDistance(a, b).value();
        covered += found.d.low <= delta && delta <= found.d.high ? 1 : 0;
    }
    const double share = static_cast<double>(covered) / kRuns;
    RecordProperty("coverage", std::to_string(share));
    EXPECT_GE(share, 0.929);  // 95 % ± 3 standard errors of 1000 runs
    EXPECT_LE(share, 0.971);
}

INSTANTIATE_TEST_SUITE_P(Known, DistanceCoverage,
                         ::testing::Values(Truth{0, 5}, Truth{1, 5}, Truth{4, 3}, Truth{4, 10}, Truth{20, 5}));

TEST(SurfaceDistance, TellsApartSurfacesAtTheThresholdInOneOf40Runs) {
    RecordProperty("hazard", "H7");
    constexpr int kRuns = 2000;
    Random random(11, "threshold");
    const auto accepted = [&](double delta) {
        int count = 0;
        for (int run = 0; run < kRuns; ++run) {
            std::vector<double> a, b;
            for (int i = 0; i < 5; ++i) {
                a.push_back(random.normal());
                b.push_back(delta + random.normal());
            }
            count += surfaceDistance(a, b).value().toldApart() ? 1 : 0;
        }
        return static_cast<double>(count) / kRuns;
    };
    EXPECT_LE(accepted(0), 0.005);  // the same surface twice
    const double atThreshold = accepted(1);
    EXPECT_GE(atThreshold, 0.0145);  // 2.5 % ± 3 standard errors
    EXPECT_LE(atThreshold, 0.0355);
    EXPECT_GE(accepted(8), 0.99);
}

}  // namespace
}  // namespace tacto
