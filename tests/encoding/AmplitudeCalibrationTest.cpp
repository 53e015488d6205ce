// What a calibrated stimulator is told, and what it then delivers.
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "core/encoding/AmplitudeCalibration.h"

namespace tacto::test {

namespace {
constexpr AmplitudeCalibration kMeasured{.gain = 0.98, .offset = 0.2, .lowest = 10, .highest = 40};
}

TEST(AmplitudeCalibration, FollowsTheLineInItsRangeAndTheNearerEndsRatioBeyond) {
    EXPECT_DOUBLE_EQ(kMeasured.delivered(25), 24.7);
    EXPECT_DOUBLE_EQ(kMeasured.delivered(40), 39.4);
    EXPECT_DOUBLE_EQ(kMeasured.delivered(80), 2 * 39.4);
    EXPECT_DOUBLE_EQ(kMeasured.delivered(5), 5.0);  // 10 gives 10
    EXPECT_EQ(kMeasured.delivered(0), 0);
    // For judging, outside its range: whichever of line and ratio is more, or less.
    EXPECT_DOUBLE_EQ(kMeasured.atMost(5), 5.1);
    EXPECT_DOUBLE_EQ(kMeasured.atLeast(5), 5.0);
    EXPECT_DOUBLE_EQ(kMeasured.atMost(80), 2 * 39.4);
    EXPECT_DOUBLE_EQ(kMeasured.atLeast(80), 78.6);
    EXPECT_EQ(kMeasured.atMost(0), 0);
    EXPECT_DOUBLE_EQ(kMeasured.atMost(25), 24.7);
    EXPECT_NEAR(kMeasured.told(39.4), 40, 1e-12);
    EXPECT_NEAR(kMeasured.told(40), 40 * 40 / 39.4, 1e-12);
    EXPECT_TRUE(std::isnan(kMeasured.told(std::numeric_limits<double>::quiet_NaN())));
}

TEST(AmplitudeCalibration, TellingUndoesDeliveringAndNeverJumps) {
    double before = 0;
    for (double wanted = 0; wanted <= 100; wanted += 0.01) {
        const double told = kMeasured.told(wanted);
        EXPECT_NEAR(kMeasured.delivered(told), wanted, 1e-10);
        EXPECT_GE(told, before);
        EXPECT_LT(told - before, 0.011);
        before = told;
    }
}

TEST(AmplitudeCalibration, RefusesAStimulatorThatIsOutOfOrder) {
    RecordProperty("hazard", "H1");
    EXPECT_TRUE(validate(kMeasured));
    EXPECT_TRUE(validate({1.2, 0, 10, 40}));
    const auto far = validate(AmplitudeCalibration{1.21, 0, 10, 40});
    ASSERT_FALSE(far);
    EXPECT_NE(far.error().message.find("21 % off; at most 20 % is accepted"), std::string::npos) << far.error().message;
    EXPECT_FALSE(validate({1, -2.1, 10, 40})) << "21 % at the low end";
    EXPECT_FALSE(validate({0, 0, 10, 40}));
    EXPECT_FALSE(validate({1, std::numeric_limits<double>::infinity(), 10, 40}));
    EXPECT_FALSE(validate({1, 0, 0, 40}));
    EXPECT_FALSE(validate({1, 0, 40, 40}));
}

TEST(AmplitudeCalibration, ChangesAmplitudesOnlyAndOnlyWhereThereIsOne) {
    PulseTrain train;
    train.amplitude = Milliamps(20);
    EXPECT_EQ(toldFor(train, std::nullopt), train);
    EXPECT_EQ(deliveredBy(train, std::nullopt), train);
    PulseTrain expected = train;
    expected.amplitude = Milliamps(kMeasured.delivered(20));
    EXPECT_EQ(deliveredBy(train, kMeasured), expected);
    EXPECT_EQ(leastDeliveredBy(train, kMeasured), expected);
    EXPECT_NEAR(siValue(toldFor(expected, kMeasured).amplitude), 0.02, 1e-15);
}

}  // namespace tacto::test
