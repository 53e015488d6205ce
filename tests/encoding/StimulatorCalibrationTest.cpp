// The values programmed for a calibrated stimulator, and what the stimulator then delivers.
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "core/encoding/StimulatorCalibration.h"

namespace tacto::test {

namespace {
constexpr CalibrationLine kMeasured{.gain = 0.98, .offset = 0.2, .lowest = 10, .highest = 40};
}

TEST(CalibrationLine, FollowsTheLineInItsRangeAndTheNearerEndsRatioBeyond) {
    EXPECT_DOUBLE_EQ(kMeasured.delivered(25), 24.7);
    EXPECT_DOUBLE_EQ(kMeasured.delivered(40), 39.4);
    EXPECT_DOUBLE_EQ(kMeasured.delivered(80), 2 * 39.4);
    EXPECT_DOUBLE_EQ(kMeasured.delivered(5), 5.0);  // as 10 gives 10
    EXPECT_EQ(kMeasured.delivered(0), 0);
    // Outside the calibrated range, judging takes the larger (or smaller) of line and ratio.
    EXPECT_DOUBLE_EQ(kMeasured.atMost(5), 5.1);
    EXPECT_DOUBLE_EQ(kMeasured.atLeast(5), 5.0);
    EXPECT_DOUBLE_EQ(kMeasured.atMost(80), 2 * 39.4);
    EXPECT_DOUBLE_EQ(kMeasured.atLeast(80), 78.6);
    EXPECT_EQ(kMeasured.atMost(0), 0);
    EXPECT_DOUBLE_EQ(kMeasured.atMost(25), 24.7);
    EXPECT_NEAR(kMeasured.programmedFor(39.4), 40, 1e-12);
    EXPECT_NEAR(kMeasured.programmedFor(40), 40 * 40 / 39.4, 1e-12);
    EXPECT_TRUE(std::isnan(kMeasured.programmedFor(std::numeric_limits<double>::quiet_NaN())));
}

TEST(CalibrationLine, TellingUndoesDeliveringAndNeverJumps) {
    double before = 0;
    for (double wanted = 0; wanted <= 100; wanted += 0.01) {
        const double programmed = kMeasured.programmedFor(wanted);
        EXPECT_NEAR(kMeasured.delivered(programmed), wanted, 1e-10);
        EXPECT_GE(programmed, before);
        EXPECT_LT(programmed - before, 0.011);
        before = programmed;
    }
}

TEST(CalibrationLine, RefusesAStimulatorThatIsOutOfOrder) {
    RecordProperty("hazard", "H1");
    EXPECT_TRUE(validate(kMeasured, "amplitude"));
    EXPECT_TRUE(validate(CalibrationLine{1.2, 0, 10, 40}, "gap"));
    const auto far = validate(CalibrationLine{1.21, 0, 10, 40}, "amplitude");
    ASSERT_FALSE(far);
    EXPECT_NE(far.error().message.find("21 % off; at most 20 % is accepted"), std::string::npos) << far.error().message;
    EXPECT_FALSE(validate(CalibrationLine{1, -2.1, 10, 40}, "gap")) << "21 % at the low end";
    EXPECT_FALSE(validate(CalibrationLine{0, 0, 10, 40}, "gap"));
    EXPECT_FALSE(validate(CalibrationLine{1, std::numeric_limits<double>::infinity(), 10, 40}, "gap"));
    EXPECT_FALSE(validate(CalibrationLine{1, 0, 0, 40}, "gap"));
    EXPECT_FALSE(validate(CalibrationLine{1, 0, 40, 40}, "gap"));
}

TEST(StimulatorCalibration, ChangesWhatItKnowsAndNothingElse) {
    PulseTrain train;
    train.amplitude = Milliamps(20);
    const KnownLines nothing;
    EXPECT_EQ(programmedFor(train, nothing), train);
    EXPECT_EQ(programmedFor(Seconds(2), nothing), Seconds(2));
    EXPECT_EQ(mostDelivered(train, nothing), train);
    const KnownLines known = StimulatorCalibration{kMeasured};
    PulseTrain expected = train;
    expected.amplitude = Milliamps(kMeasured.delivered(20));
    EXPECT_EQ(mostDelivered(train, known), expected);
    EXPECT_EQ(leastDelivered(train, known), expected);
    EXPECT_NEAR(siValue(programmedFor(expected, known).amplitude), 0.02, 1e-15);
    EXPECT_EQ(programmedFor(expected, known).phaseWidth, train.phaseWidth);
    EXPECT_EQ(programmedFor(Seconds(2), known), Seconds(2));
}

TEST(StimulatorCalibration, TellsTimesThatComeOutAsWanted) {
    RecordProperty("hazard", "H1");
    const KnownLines known = StimulatorCalibration{{1, 0, 10, 40},
                                                   CalibrationLine{1.002, -1e-3, 0.5, 2},
                                                   CalibrationLine{0.99, 3e-6, 100e-6, 400e-6},
                                                   CalibrationLine{1, -5e-6, 50e-6, 400e-6}};
    PulseTrain train;
    train.amplitude = Volts(25);
    const PulseTrain programmed = programmedFor(train, known);
    EXPECT_NEAR(programmed.phaseWidth.count(), (200 - 3) / 0.99, 1e-9);
    EXPECT_NEAR(programmed.interPhaseGap.count(), 105, 1e-9);
    EXPECT_EQ(programmed.amplitude, train.amplitude);
    EXPECT_NEAR(programmedFor(Seconds(1), known).count(), 1.001 / 1.002, 1e-12);
    train.interPhaseGap = Micros(0);
    EXPECT_EQ(programmedFor(train, known).interPhaseGap, Micros(0)) << "no gap stays none";
    EXPECT_TRUE(std::isnan(programmedFor(Seconds(std::numeric_limits<double>::quiet_NaN()), known).count()));
}

TEST(StimulatorCalibration, IsRefusedForAnyOfItsLines) {
    RecordProperty("hazard", "H9");
    const CalibrationLine sound{1, 0, 1, 2}, off{1.3, 0, 1, 2};
    EXPECT_TRUE(validate(StimulatorCalibration{sound}));
    EXPECT_TRUE(validate(StimulatorCalibration{sound, sound, sound, sound}));
    const auto message = [](const StimulatorCalibration& c) {
        const auto done = validate(c);
        return done ? std::string() : done.error().message;
    };
    EXPECT_NE(message({off, sound, sound, sound}).find("of amplitude"), std::string::npos);
    EXPECT_NE(message({sound, off, sound, sound}).find("of interval"), std::string::npos);
    EXPECT_NE(message({sound, sound, off, sound}).find("of phase width"), std::string::npos);
    EXPECT_NE(message({sound, sound, sound, off}).find("of inter-phase gap"), std::string::npos);
    EXPECT_FALSE((StimulatorCalibration{sound, sound, sound}.complete()));
}

}  // namespace tacto::test
