#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

#include "core/base/Statistics.h"
#include "core/safety/AcceptedLevels.h"
#include "tests/safety/GateFixtures.h"
#include "tests/support/Refused.h"

namespace tacto::test {

namespace {
/// A setup with a connected person, measured and ready.
struct Person : Rig {
    Person() : Rig(personSetup()) { measure(2000); }
    void measure(double ohm) { EXPECT_TRUE(gate.updateImpedance(Ohms(ohm), clock.now())); }
    bool may(double mA) { return ask(milliamps(mA)).has_value(); }
    /// Returns the peak voltage of the approved train, into the largest load used for judging.
    double peak_v() {
        std::vector<ExposureRow> rows;
        gate.exposure(rows);
        const auto row = std::ranges::find(rows, Quantity::PeakVoltage, &ExposureRow::quantity);
        return row != rows.end() ? row->value : kNaN;
    }
    /// Raises the level in steps, accepting each.
    void rampTo(double mA) {
        for (double level = 0.5; level < mA + 0.25; level += 0.5) {
            ASSERT_TRUE(may(level)) << level;
            ASSERT_TRUE(gate.accept(milliamps(level)));
        }
    }
};
}  // namespace

TEST(PersonMode, NeedsEverythingThatIsKnownOfAPerson) {
    RecordProperty("hazard", "H4");
    EXPECT_TRUE(Rig(personSetup()).configured);
    // GateCases.cpp has a case for each. A person's current source never accepts volts:
    Person rig;
    EXPECT_FALSE(rig.ask(volts(1)));
}

TEST(PersonMode, JudgesWithTheMeasuredImpedance) {
    Person rig;
    EXPECT_TRUE(rig.may(0.5));
    EXPECT_NEAR(rig.peak_v(), 0.5 * 2.6, 1e-9) << "into the measured 2 kΩ and 30 % more";
    rig.rampTo(4.5);
    // 4.5 mA · 9000 Ω is 40.5 V.
    for (const double ohm : {4000, 8000, 8800}) rig.measure(ohm);  // at most twice the previous reading
    EXPECT_TRUE(rig.may(4.5));
    rig.measure(9000);
    EXPECT_THAT(rig.ask(milliamps(4.5)), refusedSaying("commanded voltage"));
}

TEST(PersonMode, ABadReadingStopsEverythingButChecks) {
    RecordProperty("hazard", "H3");
    Person rig;
    const auto approved = rig.ask(milliamps(0.5));
    ASSERT_TRUE(approved);
    EXPECT_FALSE(rig.gate.updateImpedance(Ohms(std::numeric_limits<double>::infinity()), rig.clock.now()));
    EXPECT_FALSE(rig.gate.isCurrent(*approved)) << "an open electrode voids what was approved";
    EXPECT_FALSE(rig.may(0.5));
    EXPECT_TRUE(rig.gate.approveCheck(rig.clock.now()));
    rig.measure(2000);
    EXPECT_TRUE(rig.may(0.5));
}

TEST(PersonMode, AnOlderReadingChangesNothing) {
    Person rig;
    rig.wait(1);
    rig.measure(3000);
    EXPECT_TRUE(rig.gate.updateImpedance(Ohms(2000), rig.clock.now() - std::chrono::milliseconds(500)));
    EXPECT_TRUE(rig.may(0.5));
    EXPECT_NEAR(rig.peak_v(), 0.5 * 1.3 * 3, 1e-9);
}

TEST(PersonMode, ALevelNotYetAcceptedIsReachedByARamp) {
    RecordProperty("hazard", "H6");
    Person rig;
    EXPECT_FALSE(rig.may(2)) << "a jump";
    EXPECT_TRUE(rig.may(0.5));
    EXPECT_FALSE(rig.may(1)) << "delivered is not accepted";
    ASSERT_TRUE(rig.gate.accept(milliamps(0.5)));
    EXPECT_TRUE(rig.may(1));
    EXPECT_FALSE(rig.may(1.01));
    EXPECT_FALSE(rig.gate.accept(milliamps(3))) << "what was not permitted cannot be accepted";
    EXPECT_NEAR(rig.gate.levelCeiling(milliamps(1))->value(), 1, 1e-12);
}

TEST(PersonMode, AnAcceptedLevelMayBeEnteredInOneStep) {
    RecordProperty("hazard", "H6");
    Person rig;
    rig.rampTo(3);
    EXPECT_TRUE(rig.may(0.5));
    EXPECT_TRUE(rig.may(3));
    EXPECT_TRUE(rig.may(3.5));
    EXPECT_FALSE(rig.may(3.6));
}

TEST(PersonMode, AnotherKindOfTrainStartsAgain) {
    RecordProperty("hazard", "H6");
    Person rig;
    rig.rampTo(3);
    PulseTrain longer = milliamps(3);
    longer.phaseWidth = Micros(1000);
    EXPECT_FALSE(rig.ask(longer)) << "five times the charge at an accepted current";
    longer.amplitude = Milliamps(0.5);
    EXPECT_TRUE(rig.ask(longer));
}

TEST(PersonMode, AscendingLimitsHaveTheirOwnCeiling) {
    RecordProperty("hazard", "H6");
    Person rig;
    rig.rampTo(3);
    rig.gate.beginAscending();
    EXPECT_FALSE(rig.may(1)) << "accepted before, but this series starts from nothing";
    EXPECT_TRUE(rig.may(0.5));
    ASSERT_TRUE(rig.gate.accept(milliamps(0.5)));
    EXPECT_TRUE(rig.may(1));
    EXPECT_FALSE(rig.may(1.5));
    rig.gate.endAscending();
    EXPECT_TRUE(rig.may(3));
}

TEST(PersonMode, NothingExceedsTheDiscomfortLimitAfterwards) {
    RecordProperty("hazard", "H6");
    Person rig;
    rig.rampTo(3);
    const auto approved = rig.ask(milliamps(3));
    ASSERT_TRUE(approved);
    ASSERT_TRUE(rig.gate.reportDiscomfort(Milliamps(2.5)));
    EXPECT_FALSE(rig.gate.isCurrent(*approved));
    EXPECT_FALSE(rig.may(2.6));
    EXPECT_TRUE(rig.may(2.5));
    ASSERT_TRUE(rig.gate.reportDiscomfort(Milliamps(4)));
    EXPECT_FALSE(rig.may(2.6)) << "a later, higher report does not raise it";
    // Configuring again for the same participant does not raise it either.
    ASSERT_TRUE(rig.gate.configure(personSetup()));
    rig.measure(2000);
    EXPECT_FALSE(rig.may(2.6));
    EXPECT_TRUE(rig.may(2.5)) << "what was accepted stays accepted";
    EXPECT_FALSE(rig.gate.reportDiscomfort(Milliamps(std::numeric_limits<double>::quiet_NaN())));
}

TEST(PersonMode, AnotherParticipantHasAcceptedNothing) {
    RecordProperty("hazard", "H6");
    Person rig;
    rig.rampTo(3);
    GateSetup setup = personSetup();
    setup.person->participant = "P02";
    ASSERT_TRUE(rig.gate.configure(setup));
    rig.measure(2000);
    EXPECT_FALSE(rig.may(1));
    EXPECT_TRUE(rig.may(0.5));
}

TEST(PersonMode, AParticipantWhoComesBackKeepsTheirOwnLimit) {
    RecordProperty("hazard", "H6");
    Person rig;
    rig.rampTo(3);
    ASSERT_TRUE(rig.gate.reportDiscomfort(Milliamps(2.5)));
    GateSetup other = personSetup();
    other.person->participant = "P02";
    ASSERT_TRUE(rig.gate.configure(other));
    ASSERT_TRUE(rig.gate.configure(personSetup()));
    rig.measure(2000);
    EXPECT_FALSE(rig.may(2.6));
    EXPECT_TRUE(rig.may(2.5));
}

TEST(PersonMode, LevelsAreNotAcceptedOnABenchLoad) {
    Rig rig(benchSetup());
    EXPECT_EQ(rig.gate.accept(milliamps(1)).error().code, ErrorCode::NotArmed);
    EXPECT_EQ(rig.gate.reportDiscomfort(Milliamps(1)).error().code, ErrorCode::NotArmed);
    EXPECT_FALSE(rig.gate.levelCeiling(milliamps(1)));
}

TEST(AcceptedLevels, ALimitPermitsItsOwnLevelOnTheDeviceGrid) {
    RecordProperty("hazard", "H6");
    for (int k = 1; k <= 260; ++k) {
        const double level = 0.5 * k;
        AcceptedLevels levels;
        levels.begin(Milliamps(level), Milliamps(1000));
        EXPECT_TRUE(levels.permits(milliamps(level))) << level;
        levels.begin(Milliamps(1000), Milliamps(1000), Milliamps(level));
        EXPECT_TRUE(levels.permits(milliamps(level))) << level;
        EXPECT_FALSE(levels.permits(milliamps(level + 0.5))) << level;
    }
}

TEST(AcceptedLevels, DecimalStepsMeetTheirCeiling) {
    AcceptedLevels levels;
    levels.begin(Milliamps(5), Milliamps(0.1));
    for (int k = 1; k <= 50; ++k) {
        ASSERT_TRUE(levels.permits(milliamps(0.1 * k))) << k;
        ASSERT_TRUE(levels.accept(milliamps(0.1 * k)));
    }
    EXPECT_FALSE(levels.permits(milliamps(5.1)));
    EXPECT_FALSE(levels.permits(milliamps(std::numeric_limits<double>::quiet_NaN())));
}

namespace {
/// A person at a massager with levels that rise by 0.1.
struct Vibrated : Rig {
    Vibrated() : Rig(vibrationSetup()) { EXPECT_TRUE(configured); }
    bool may(double intensity) { return gate.approve(VibrationBurst{intensity}).has_value(); }
    void rampTo(double intensity) {
        for (double level = 0.1; level < intensity + 0.05; level += 0.1) {
            ASSERT_TRUE(may(level)) << level;
            ASSERT_TRUE(gate.acceptIntensity(level));
        }
    }
};
}  // namespace

TEST(PersonAtAMassager, ReachesAnIntensityByStepsThatWereAccepted) {
    RecordProperty("hazard", "H6");
    Vibrated rig;
    EXPECT_FALSE(rig.may(0.2)) << "nothing was accepted yet";
    rig.rampTo(0.5);
    EXPECT_TRUE(rig.may(0.6));
    EXPECT_FALSE(rig.may(0.7));
    rig.gate.beginAscending();
    EXPECT_TRUE(rig.may(0.1)) << "a series starts from nothing";
    EXPECT_FALSE(rig.may(0.2));
    EXPECT_NEAR(*rig.gate.intensityCeiling(), 0.1, 1e-9);
    rig.gate.endAscending();
    EXPECT_TRUE(rig.may(0.5)) << "an accepted one in one step";
}

TEST(PersonAtAMassager, KeepsTheDiscomfortLimitThroughAnArming) {
    RecordProperty("hazard", "H6");
    Vibrated rig;
    rig.rampTo(0.5);
    const auto approved = rig.gate.approve(VibrationBurst{0.5});
    ASSERT_TRUE(approved);
    ASSERT_TRUE(rig.gate.reportUncomfortable(0.3));
    EXPECT_FALSE(rig.gate.isCurrent(*approved)) << "what was approved before the word is void";
    ASSERT_TRUE(rig.gate.configure(vibrationSetup()));
    EXPECT_TRUE(rig.may(0.3));
    EXPECT_FALSE(rig.may(0.4));
    ASSERT_TRUE(rig.gate.reportUncomfortable(0.9));
    EXPECT_FALSE(rig.may(0.4)) << "it only falls";
    auto another = vibrationSetup();
    another.person->participant = "P03";
    ASSERT_TRUE(rig.gate.configure(another));
    EXPECT_FALSE(rig.may(0.3)) << "another person has accepted nothing";
}

TEST(PersonAtAMassager, GetsNoCurrent) {
    RecordProperty("hazard", "H4");
    auto setup = vibrationSetup();
    setup.source = currentSource();
    Rig rig(setup);
    ASSERT_TRUE(rig.configured);
    ASSERT_TRUE(rig.gate.updateImpedance(Ohms(2000), rig.clock.now()));
    EXPECT_FALSE(rig.ask(milliamps(0.5)));
    EXPECT_FALSE(rig.gate.approveCheck(rig.clock.now()));
    EXPECT_FALSE(rig.gate.accept(milliamps(0.5)));
    EXPECT_TRUE(rig.gate.approve(VibrationBurst{0.1}));
}

}  // namespace tacto::test
