// A step of the command as seen in the trains: how the scheduler is designed to carry it out, and when it is complete.
#include <cmath>
#include <gtest/gtest.h>

#include "core/encoding/StepResponse.h"
#include "core/encoding/Transitions.h"

namespace tacto {
namespace {

Command at(double volts, double seconds) { return {Volts(volts), Seconds(seconds)}; }

StepResponse designOf(const EncodingProfile& profile, const StepEnds& ends) {
    return respond(ends, designedTrains(profile, ends).value());
}

TEST(StepResponse, APressPullsTheTrainForwardToTheNewInterval) {
    const StepEnds early{Seconds(0.3), at(25, 2), at(25, 0.5)};
    EXPECT_NEAR(designOf({}, early).latency.value().count(), 0.2, 1e-8);
    EXPECT_EQ(designOf({}, early).trains, 1);
}

TEST(StepResponse, APressLaterThanTheNewIntervalIsFeltAtOnce) {
    const StepEnds late{Seconds(1.3), at(25, 2), at(25, 0.5)};
    EXPECT_NEAR(designOf({}, late).latency.value().count(), 0, 1e-8);
    EXPECT_EQ(designOf({}, late).trains, 1);
}

TEST(StepResponse, AReleaseMovesTheTrainBack) {
    const StepEnds ends{Seconds(0.3), at(25, 0.5), at(25, 2)};
    EXPECT_NEAR(designOf({}, ends).latency.value().count(), 1.7, 1e-8);
    EXPECT_EQ(designOf({}, ends).trains, 1);
}

TEST(StepResponse, TextureWaitsForThePendingTrain) {
    const StepEnds ends{Seconds(0.4), at(10, 1.25), at(40, 1.25)};
    EXPECT_NEAR(designOf({}, ends).latency.value().count(), 0.85, 1e-8);
    EXPECT_EQ(designOf({}, ends).trains, 1);
}

TEST(StepResponse, SlewLimitsSpreadAStepOverTrains) {
    EncodingProfile profile;
    profile.intervalRatioPerTrain = 1.2;
    // ln 4 / ln 1.2 = 7.6: the eighth train has the new interval.
    EXPECT_EQ(designOf(profile, {Seconds(0.3), at(25, 2), at(25, 0.5)}).trains, 8);
    EXPECT_NEAR(designOf(profile, {Seconds(0.3), at(25, 2), at(25, 0.5)}).latency.value().count(), 2 / 1.2 - 0.3, 1e-8);
    // The step comes late: the first train comes at once, but does not have the new interval yet.
    EXPECT_EQ(designOf(profile, {Seconds(1.8), at(25, 2), at(25, 0.5)}).trains, 8);

    // An interval between the old and the new one does not complete the step, although it is longer.
    EncodingProfile ratio;
    ratio.intervalRatioPerTrain = 1.34;
    EXPECT_EQ(designOf(ratio, {Seconds(0.4), at(25, 0.8), at(25, 0.5)}).trains, 2);

    EncodingProfile slow;
    slow.amplitudeSlew_V_per_s = 10;  // 12.5 V per train at 1.25 s: 30 V take three trains
    EXPECT_EQ(designOf(slow, {Seconds(0.4), at(10, 1.25), at(40, 1.25)}).trains, 3);
}

TEST(StepResponse, LeavesOpenWhichTrainOfACreepingAmplitudeCarriesIt) {
    EncodingProfile slow;
    slow.amplitudeSlew_V_per_s = 0.25;  // 0.3125 V per train: at 40 V a twelfth of a just noticeable difference
    const StepEnds down{Seconds(0.4), at(40, 1.25), at(10, 1.25)};
    const auto trains = designedTrains(slow, down).value();
    const auto range = rangeOf(down, trains);
    // 0.2 and 0.3 just noticeable differences below 40 V are 0.76 and 1.13 V: the third and the fourth train.
    EXPECT_NEAR(range.first.latency.value().count(), 0.85 + 2 * 1.25, 1e-8);
    EXPECT_NEAR(range.last.latency.value().count(), 0.85 + 3 * 1.25, 1e-8);
    EXPECT_LE(range.first.trains.value(), respond(down, trains).trains.value());
    EXPECT_GE(range.last.trains.value(), respond(down, trains).trains.value());

    const StepEnds jump{Seconds(0.4), at(40, 1.25), at(10, 1.25)};
    const auto whole = rangeOf(jump, designedTrains({}, jump).value());
    EXPECT_EQ(whole.first.latency, whole.last.latency) << "a whole step leaves nothing open";
    EXPECT_EQ(whole.first.trains, whole.last.trains);
}

TEST(StepResponse, OfTrainsThatNeverChangeIsNothing) {
    const StepEnds ends{Seconds(0.4), at(10, 1), at(40, 1)};
    const std::vector<StepTrain> same{
        {Seconds(0.6), Volts(10)}, {Seconds(1.6), Volts(10.1)}, {Seconds(2.6), Volts(9.9)}};
    const auto found = respond(ends, same);
    EXPECT_FALSE(found.latency);
    EXPECT_FALSE(found.trains);
    EXPECT_FALSE(respond(ends, {}).latency);
}

TEST(StepResponse, ATrainThatCouldNotBeMeasuredCarriesTheIntervalOnly) {
    RecordProperty("hazard", "H9");
    const StepEnds ends{Seconds(0.4), at(10, 1), at(40, 1)};
    const std::vector<StepTrain> blind{{Seconds(0.6), Volts(std::nan(""))}, {Seconds(1.6), Volts(std::nan(""))}};
    EXPECT_FALSE(respond(ends, blind).latency);
    EXPECT_FALSE(respond(ends, blind).trains);
}

TEST(StepResponse, RefusesAMomentOutsideTheInterval) {
    for (const double since : {-0.1, 2.1, std::nan("")}) {
        EXPECT_FALSE(designedTrains({}, {Seconds(since), at(25, 2), at(25, 0.5)})) << since;
    }
    EncodingProfile endless;
    endless.amplitudeSlew_V_per_s = 1e-6;
    EXPECT_FALSE(designedTrains(endless, {Seconds(0.1), at(10, 0.5), at(40, 0.5)}));
}

TEST(TransitionMap, HoldsTheLargestStepOfEveryCell) {
    const auto report = sweepTransitions({}, {11, Seconds(5)}).value();
    const auto map = mapOf(report.steps, 11).value();
    ASSERT_EQ(map.amplitude.size(), 11U);
    double amplitude = 0, interval = 0;
    for (std::size_t p = 0; p < 11; ++p) {
        for (std::size_t r = 0; r < 11; ++r) {
            amplitude = std::fmax(amplitude, map.amplitude[p][r]);
            interval = std::fmax(interval, map.interval[p][r]);
            EXPECT_TRUE(std::isfinite(map.amplitude[p][r])) << r << ", " << p;
        }
    }
    EXPECT_DOUBLE_EQ(amplitude, report.gradual.amplitude.amplitude);
    EXPECT_DOUBLE_EQ(interval, report.gradual.interval.interval);
    // The worst step is at the place reported.
    const auto& worst = report.gradual.amplitude;
    EXPECT_DOUBLE_EQ(map.amplitude[static_cast<std::size_t>(std::lround(worst.P * 10))]
                                  [static_cast<std::size_t>(std::lround(worst.R * 10))],
                     amplitude);
}

TEST(TransitionMap, CoversTheWayBetweenTwoTrainsAndNothingElse) {
    TransitionStep step;
    step.way = {0.2, 0.6, 0, 0};
    step.amplitude = 3;
    const auto map = mapOf({step}, 11).value();
    for (std::size_t r = 0; r < 11; ++r) {
        const double cell = map.amplitude[0][r];
        if (r < 2 || r > 6) {
            EXPECT_TRUE(std::isnan(cell)) << r;
        } else {
            EXPECT_EQ(cell, 3) << r;
        }
        EXPECT_TRUE(std::isnan(map.amplitude[1][r]));
    }
    EXPECT_FALSE(mapOf({}, 1));
}

}  // namespace
}  // namespace tacto
