#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "core/acquisition/StreamHealth.h"
#include "core/base/Random.h"

using namespace tacto;
using testing::HasSubstr;

namespace {

HealthReport examine(const std::vector<double>& stamps, double rate_hz) {
    StreamHealth health(rate_hz);
    for (const double t : stamps) health.feed(t);
    return health.report();
}

std::vector<double> regular(std::size_t count, double rate_hz, double from = 0) {
    std::vector<double> stamps;
    for (std::size_t i = 0; i < count; ++i) stamps.push_back(from + static_cast<double>(i) / rate_hz);
    return stamps;
}

double printed(double t, double resolution) { return std::round(t / resolution) * resolution; }

}  // namespace

TEST(StreamHealth, FindsNothingInARegularStream) {
    const auto report = examine(regular(1000, 200), 200);
    EXPECT_TRUE(report.continuous());
    EXPECT_EQ(report.samples, 1000U);
    EXPECT_NEAR(report.rate_hz, 200, 1e-9);
    EXPECT_EQ(report.text(), "continuous");
}

TEST(StreamHealth, TakesJitterBelowHalfAStepForRegular) {
    RecordProperty("hazard", "H7");
    Random random(7, "jitter");
    auto stamps = regular(5000, 200, 10);
    for (auto& t : stamps) t += (random.uniform() - 0.5) * 0.8 / 200;
    EXPECT_EQ(examine(stamps, 200).gaps, 0U);
    EXPECT_EQ(examine(stamps, 200).irregular, 0U);
}

TEST(StreamHealth, FindsASingleLostSample) {
    RecordProperty("hazard", "H7");
    Random random(8, "jitter");
    auto stamps = regular(1000, 200);
    for (auto& t : stamps) t += (random.uniform() - 0.5) * 0.4 / 200;
    stamps.erase(stamps.begin() + 500);
    const auto report = examine(stamps, 200);
    EXPECT_EQ(report.gaps, 1U);
    EXPECT_EQ(report.missingSamples, 1U);
    EXPECT_EQ(report.repeats + report.clockSteps + report.irregular, 0U);
}

TEST(StreamHealth, CountsGapsRepeatsAndClockSteps) {
    RecordProperty("hazard", "H7");
    auto stamps = regular(100, 100);                                    // to 0.99
    for (const double t : regular(100, 100, 1.5)) stamps.push_back(t);  // a gap of 0.51 s, to 2.49
    stamps.push_back(2.49);                                             // a repeat
    stamps.push_back(2.50);
    stamps.push_back(1.00);  // the clock is set back
    const auto report = examine(stamps, 100);
    EXPECT_EQ(report.gaps, 1U);
    EXPECT_EQ(report.missingSamples, 50U);
    EXPECT_NEAR(report.longestGap_s, 0.51, 1e-9);
    EXPECT_EQ(report.repeats, 1U);
    EXPECT_EQ(report.clockSteps, 1U);
    EXPECT_FALSE(report.continuous());
    EXPECT_THAT(report.text(), HasSubstr("1 gap (longest 0.51 s, about 50 samples missing)"));
}

TEST(StreamHealth, MeasuresTheRateOverTheLongestGapFreeStretch) {
    auto stamps = regular(100, 1000);
    for (const double t : regular(1001, 1010, 5)) stamps.push_back(t);  // the longer stretch runs a little faster
    for (const double t : regular(50, 1000, 20)) stamps.push_back(t);
    EXPECT_NEAR(examine(stamps, 1000).rate_hz, 1010, 1e-6);
}

TEST(StreamHealth, IsNotMisledByRoundedStamps) {
    auto stamps = regular(13200, 2200);
    for (auto& t : stamps) t = printed(t, 1e-6);
    EXPECT_NEAR(roughRate_hz(stamps), 2200, 0.01);
    const auto report = examine(stamps, roughRate_hz(stamps));
    EXPECT_NEAR(report.rate_hz, 2200, 0.001) << "the median step says 2197.8";
    EXPECT_TRUE(report.continuous());
}

TEST(StreamHealth, CountsWhatIsNotANumber) {
    RecordProperty("hazard", "H7");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    StreamHealth health(100);
    SampleBlock block{{0, 0.01, nan, 0.03}, {1, 2, 3, nan, 5, 6, 7, 8}};
    health.feed(block, 2);
    EXPECT_EQ(health.report().invalidStamps, 1U);
    EXPECT_EQ(health.report().invalidSamples, 1U);
    EXPECT_EQ(health.report().gaps, 1U) << "behind a stamp that is not a number a sample is missing";
}

TEST(StreamHealth, KnowsItsAge) {
    RecordProperty("hazard", "H7");
    StreamHealth health(100);
    EXPECT_TRUE(health.stale(0)) << "nothing came yet";
    health.feed(1.0);
    EXPECT_NEAR(health.age_s(1.05), 0.05, 1e-12);
    EXPECT_FALSE(health.stale(1.05));
    EXPECT_TRUE(health.stale(1.11));
    EXPECT_TRUE(health.stale(std::numeric_limits<double>::quiet_NaN()));
    health.feed(0.5);
    EXPECT_NEAR(health.age_s(1.05), 0.05, 1e-12) << "a stamp from the past makes nothing younger";
}

TEST(StreamHealth, SpreadsStampsThatArePrintedTooCoarsely) {
    auto stamps = regular(4001, 4000);
    for (auto& t : stamps) t = std::floor(t * 1000 + 1e-9) / 1000;
    ASSERT_TRUE(stampsAreCoarse(stamps));
    spreadCoarseStamps(stamps);
    EXPECT_FALSE(stampsAreCoarse(stamps));
    EXPECT_NEAR(examine(stamps, roughRate_hz(stamps)).rate_hz, 4000, 1);
    EXPECT_TRUE(examine(stamps, roughRate_hz(stamps)).continuous());
}

TEST(StreamHealth, LeavesAFewRepeatsToBeCounted) {
    auto stamps = regular(20, 100);
    stamps.insert(stamps.begin() + 10, stamps[10]);
    EXPECT_FALSE(stampsAreCoarse(stamps));
}
