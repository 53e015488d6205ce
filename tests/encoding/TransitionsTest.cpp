#include <cmath>
#include <gtest/gtest.h>

#include "core/encoding/Transitions.h"

namespace tacto {
namespace {

TEST(PerceptualDistance, CountsJustNoticeableDifferences) {
    EXPECT_NEAR(amplitudeDistance(Volts(11), Volts(10)), 1, 1e-12);
    EXPECT_NEAR(intervalDistance(Seconds(1), Seconds(1.16)), 1, 1e-12);
    EXPECT_NEAR(amplitudeDistance(Volts(10), Volts(40)), std::log(4) / std::log(1.1), 1e-12);
    EXPECT_EQ(intervalDistance(Seconds(2), Seconds(2)), 0);
}

TEST(Transitions, JumpTheWholeRangeInOneStepWithoutSlewLimits) {
    const auto report = sweepTransitions(EncodingProfile{}, {3, Seconds(4)});
    ASSERT_TRUE(report);
    EXPECT_NEAR(report->abrupt.amplitude.amplitude, std::log(4) / std::log(1.1), 1e-9);
    EXPECT_NEAR(report->abrupt.interval.interval, std::log(4) / std::log(1.16), 1e-9);
    EXPECT_GT(report->abrupt.largest(), 2) << "which is why slew limits exist";
}

TEST(Transitions, StayWithinTwoDifferencesWithSuitableSlewLimits) {
    EncodingProfile profile;
    profile.intervalRatioPerTrain = 1.3;
    profile.amplitudeSlew_V_per_s = 1;
    const auto report = sweepTransitions(profile, {3, Seconds(4)});
    ASSERT_TRUE(report);
    EXPECT_LE(report->abrupt.interval.interval, std::log(1.3) / std::log(1.16) + 0.01) << "and a step of the loop";
    EXPECT_LE(report->abrupt.largest(), 2.0);
    EXPECT_LE(report->gradual.largest(), 2.0);
    EXPECT_GT(report->abrupt.largest(), 0);
}

TEST(Transitions, OfRatiosPerTrainAreTheSameEverywhere) {
    EncodingProfile profile;
    profile.amplitudeRatioPerTrain = 1.2;
    profile.intervalRatioPerTrain = 1.34;
    const auto report = sweepTransitions(profile, {3, Seconds(5)});
    ASSERT_TRUE(report);
    EXPECT_NEAR(report->gradual.amplitude.amplitude, std::log(1.2) / std::log(1.1), 1e-9);
    EXPECT_NEAR(report->abrupt.amplitude.amplitude, std::log(1.2) / std::log(1.1), 1e-9);
    EXPECT_LE(report->gradual.largest(), 2.0);
    EXPECT_LE(report->abrupt.largest(), 2.0);
}

TEST(Transitions, TakeSmallerStepsWhenTheFingerMovesSlowly) {
    const auto fast = sweepTransitions(EncodingProfile{}, {3, Seconds(2)});
    const auto slow = sweepTransitions(EncodingProfile{}, {3, Seconds(40)});
    ASSERT_TRUE(fast && slow);
    EXPECT_LT(slow->gradual.largest(), fast->gradual.largest());
    EXPECT_GT(slow->steps.size(), fast->steps.size());
}

TEST(Transitions, ReportTheLargestOfTheirOwnSteps) {
    const auto report = sweepTransitions(EncodingProfile{}, {2, Seconds(5)});
    ASSERT_TRUE(report);
    double largest = 0;
    for (const auto& step : report->steps) {
        largest = std::max({largest, step.amplitude, step.interval});
        EXPECT_DOUBLE_EQ(step.amplitude, amplitudeDistance(step.from.amplitude, step.to.amplitude));
        EXPECT_DOUBLE_EQ(step.interval, intervalDistance(step.from.interval, step.to.interval));
    }
    EXPECT_DOUBLE_EQ(report->gradual.largest(), largest);
}

TEST(Transitions, RefuseASweepThatIsNone) {
    EXPECT_FALSE(sweepTransitions(EncodingProfile{}, {1, Seconds(5)}));
    EXPECT_FALSE(sweepTransitions(EncodingProfile{}, {3, Seconds(0)}));
    EXPECT_FALSE(sweepTransitions(EncodingProfile{}, {3, Seconds(std::nan(""))}));
    EncodingProfile broken;
    broken.train.pulses = 0;
    EXPECT_FALSE(sweepTransitions(broken));
}

}  // namespace
}  // namespace tacto
