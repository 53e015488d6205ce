#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/encoding/Rounding.h"

namespace tacto {
namespace {

using testing::HasSubstr;

constexpr DeviceGrid kGrid{0.5, 60, Micros(10), Micros(20), Micros(4000), 100};

PulseTrain volts(double v) {
    PulseTrain train;
    train.amplitude = Volts(v);
    return train;
}

double amplitudeOf(const RoundedTrain& rounded) { return siValue(rounded.train.amplitude); }

TEST(TowardZero, TakesTheMultipleBelowAndToleratesBinaryFractions) {
    EXPECT_DOUBLE_EQ(towardZero(0.3, 0.1), 0.3);
    EXPECT_DOUBLE_EQ(towardZero(0.29999, 0.1), 0.2);
    EXPECT_DOUBLE_EQ(towardZero(-0.39, 0.1), -0.3);
    EXPECT_DOUBLE_EQ(towardZero(12.34, 0), 12.34) << "a step of 0 is continuous";
    EXPECT_EQ(towardZero(0.05, 0.1), 0);
}

TEST(RoundToDevice, LeavesATrainOnTheGridAlone) {
    const auto rounded = roundToDevice(volts(40), kGrid);
    ASSERT_TRUE(rounded);
    EXPECT_FALSE(rounded->changed());
    EXPECT_EQ(rounded->train, volts(40));
}

TEST(RoundToDevice, RoundsTowardZeroAndRecordsByHowMuch) {
    PulseTrain wanted = volts(12.4);
    wanted.phaseWidth = Micros(208);
    wanted.interPhaseGap = Micros(109);
    wanted.pulses = 1;
    const auto rounded = roundToDevice(wanted, kGrid);
    ASSERT_TRUE(rounded) << rounded.error().message;
    EXPECT_DOUBLE_EQ(amplitudeOf(*rounded), 12.0);
    EXPECT_DOUBLE_EQ(rounded->amplitude, 0.4 / 12.4);
    EXPECT_DOUBLE_EQ(rounded->train.phaseWidth.count(), 200);
    EXPECT_DOUBLE_EQ(rounded->phaseWidth, 8.0 / 208);
    EXPECT_DOUBLE_EQ(rounded->train.interPhaseGap.count(), 100);
    EXPECT_DOUBLE_EQ(rounded->gap, 9.0 / 109);
    EXPECT_TRUE(rounded->changed());
}

TEST(RoundToDevice, RoundsMilliampsInMilliamps) {
    PulseTrain wanted;
    wanted.amplitude = Milliamps(11.7);
    const auto rounded = roundToDevice(wanted, kGrid);
    ASSERT_TRUE(rounded);
    ASSERT_TRUE(isCurrent(rounded->train.amplitude));
    EXPECT_DOUBLE_EQ(std::get<Milliamps>(rounded->train.amplitude).value(), 11.5);
}

TEST(RoundToDevice, HoldsTheRangeIfThatTakesTenPercentAtMost) {
    const auto rounded = roundToDevice(volts(66), kGrid);
    ASSERT_TRUE(rounded);
    EXPECT_DOUBLE_EQ(amplitudeOf(*rounded), 60);
    EXPECT_FALSE(roundToDevice(volts(67), kGrid));
}

TEST(RoundToDevice, RefusesMoreThanTenPercentNamingTheValueAndTheDevice) {
    const auto amplitude = roundToDevice(volts(1.9), {1, 60, Micros(1), Micros(10), Micros(4000), 10});
    ASSERT_FALSE(amplitude);
    EXPECT_EQ(amplitude.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(amplitude.error().message, AllOf(HasSubstr("1.9 V"), HasSubstr("steps of 1")));
    EXPECT_FALSE(roundToDevice(volts(0.4), kGrid)) << "silence is not 0.4 V";
    PulseTrain wide = volts(40);
    wide.phaseWidth = Micros(4600);
    EXPECT_THAT(roundToDevice(wide, kGrid).error().message, HasSubstr("phase width 4600"));
    wide.phaseWidth = Micros(4300);
    EXPECT_DOUBLE_EQ(roundToDevice(wide, kGrid)->train.phaseWidth.count(), 4000);
    PulseTrain narrow = volts(40);
    narrow.phaseWidth = Micros(15);
    EXPECT_THAT(roundToDevice(narrow, kGrid).error().message, HasSubstr("phase width 15"));
    PulseTrain gap = volts(40);
    gap.interPhaseGap = Micros(5);
    EXPECT_THAT(roundToDevice(gap, kGrid).error().message, HasSubstr("inter-phase gap 5"));
    PulseTrain many = volts(40);
    many.pulses = 120;
    EXPECT_THAT(roundToDevice(many, kGrid).error().message, HasSubstr("120 pulses"));
    many.pulses = 110;
    EXPECT_EQ(roundToDevice(many, kGrid)->train.pulses, 100);
}

TEST(RoundToDevice, RefusesATrainThatIsNone) {
    EXPECT_FALSE(roundToDevice(volts(std::nan("")), kGrid));
    EXPECT_FALSE(roundToDevice(volts(-1), kGrid));
}

TEST(RoundToDevice, LeavesAmplitudeZeroAtZero) {
    const auto rounded = roundToDevice(volts(0), kGrid);
    ASSERT_TRUE(rounded);
    EXPECT_FALSE(rounded->changed());
}

RC_GTEST_PROP(RoundToDevice, NeverAddsAndNeverTakesMoreThanTenPercent, ()) {
    DeviceGrid grid{*rc::gen::inRange(0, 300) / 100.0,    *rc::gen::inRange(1, 1000) / 10.0,
                    Micros(*rc::gen::inRange(0, 50)),     Micros(*rc::gen::inRange(1, 100)),
                    Micros(*rc::gen::inRange(100, 5000)), *rc::gen::inRange(1, 50)};
    // Mostly within the device's range, sometimes slightly above.
    const auto share = [] { return *rc::gen::inRange(1, 1080) / 1000.0; };
    PulseTrain wanted = volts(grid.amplitudeMax * share());
    wanted.phaseWidth = grid.widthMax * share();
    wanted.interPhaseGap = Micros(*rc::gen::inRange(0, 10'000) / 9.7);
    wanted.pulses = *rc::gen::inRange(1, grid.pulsesMax + 3);
    wanted.rate = Hertz(10);
    const auto rounded = roundToDevice(wanted, grid);
    RC_CLASSIFY(rounded.has_value(), "delivered");
    if (!rounded) return;
    const auto kept = [](double before, double after) {
        return after <= before * (1 + 1e-9) && after >= before * 0.9 * (1 - 1e-8);
    };
    RC_ASSERT(kept(siValue(wanted.amplitude), amplitudeOf(*rounded)));
    RC_ASSERT(kept(wanted.phaseWidth.count(), rounded->train.phaseWidth.count()));
    RC_ASSERT(kept(wanted.interPhaseGap.count(), rounded->train.interPhaseGap.count()));
    RC_ASSERT(kept(wanted.pulses, rounded->train.pulses));
    RC_ASSERT(amplitudeOf(*rounded) <= grid.amplitudeMax);
    RC_ASSERT(rounded->train.phaseWidth <= grid.widthMax);
    RC_ASSERT(rounded->train.phaseWidth >= grid.widthMin * (1 - 1e-9));
    // Rounding a rounded train changes nothing.
    const auto twice = roundToDevice(rounded->train, grid);
    RC_ASSERT(twice.has_value());
    RC_ASSERT(!twice->changed());
}

}  // namespace
}  // namespace tacto
