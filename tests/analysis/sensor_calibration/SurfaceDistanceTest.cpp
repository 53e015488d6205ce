// d' and its interval, compared with scipy (tests/reference/estimates.py) and with seeded repetitions of known truth.
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/sensor_calibration/SurfaceDistance.h"
#include "core/base/Random.h"
#include "tests/support/Figures.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

TEST(NoncentralT, AgreesWithScipy) {
    for (const auto& scipy : test::figuresOf("estimates").at("noncentral_t"))
        EXPECT_NEAR(noncentralT(scipy.at("t"), scipy.at("nu"), scipy.at("delta")), scipy.at("p").get<double>(), 1e-6)
            << scipy;
    EXPECT_TRUE(std::isnan(noncentralT(NAN, 4, 1)));
    EXPECT_TRUE(std::isnan(noncentralT(1, 0.5, 1)));
}

TEST(SurfaceDistance, AgreesWithScipy) {
    const auto found = [](const char* name, double tolerance) {
        const auto& scipy = test::figuresOf("estimates").at("distance").at(name);
        const auto distance =
            surfaceDistance(scipy.at("a").get<std::vector<double>>(), scipy.at("b").get<std::vector<double>>()).value();
        EXPECT_NEAR(distance.pooledSd, scipy.at("pooled_sd").get<double>(), 1e-12) << name;
        EXPECT_NEAR(distance.d.value, scipy.at("d").get<double>(), 1e-10) << name;
        EXPECT_NEAR(distance.d.low, scipy.at("low").get<double>(), tolerance) << name;
        EXPECT_NEAR(distance.d.high, scipy.at("high").get<double>(), tolerance) << name;
        return distance;
    };
    EXPECT_TRUE(found("far", 1e-6).toldApart());
    EXPECT_FALSE(found("near", 1e-5).toldApart());
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
    RecordProperty("hazard", "H9");
    EXPECT_THAT(surfaceDistance(std::vector{1.0, 2.0}, std::vector{1.0, 2.0, 3.0}),
                test::refusedSaying("one surface has only 2 slides; at least 3"));
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
    EXPECT_GE(share, 0.929);  // 95 %, less 3 standard errors of 1000 runs
    EXPECT_LE(share, 0.971);
}

INSTANTIATE_TEST_SUITE_P(Known, DistanceCoverage,
                         ::testing::Values(Truth{0, 5}, Truth{1, 5}, Truth{4, 3}, Truth{4, 10}, Truth{20, 5}));

TEST(SurfaceDistance, TellsApartSurfacesAtTheThresholdInOneOf40Runs) {
    RecordProperty("hazard", "H9");
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
    EXPECT_LE(accepted(0), 0.005);  // both are the same surface
    const double atThreshold = accepted(1);
    EXPECT_GE(atThreshold, 0.0145);  // 2.5 %, less 3 standard errors
    EXPECT_LE(atThreshold, 0.0355);
    EXPECT_GE(accepted(8), 0.99);
}

}  // namespace
}  // namespace tacto
