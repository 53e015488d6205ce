#include <gtest/gtest.h>

#include "core/measure/PulseMeasurement.h"
#include "tests/measure/SyntheticPulses.h"

namespace tacto::test {
namespace {

/// Returns a record with trains of three pulses at 100 Hz, every 0.5 s.
Capture longRecord() {
    std::vector<SyntheticPhase> phases;
    for (int train = 0; train < 3; ++train) {
        for (int pulse = 0; pulse < 3; ++pulse) append(phases, biphasic(0.1 + train * 0.5 + pulse * 0.01));
    }
    return recordOf(phases, {.rate_hz = 500e3, .samples = 600'000, .noise = 0.05});
}

TEST(Trains, WithoutARateEachPulseIsItsOwnTrain) {
    const auto m = measureChannel(longRecord(), 0);
    EXPECT_EQ(m.trains.size(), 9U);
    EXPECT_NEAR(m.interval_s.min, 0.01, 1e-6);
}

TEST(Trains, AreGroupedByTheirRateAndTheIntervalIsOnsetToOnset) {
    const auto m = measureChannel(longRecord(), 0, {.intraTrainRate = Hertz(100)});
    ASSERT_EQ(m.trains.size(), 3U);
    EXPECT_EQ(m.trains[1].pulses, 3U);
    EXPECT_NEAR(m.trains[1].onset_s, 0.6, 1e-7);
    EXPECT_EQ(m.interval_s.n, 2U);
    EXPECT_NEAR(m.interval_s.mean, 0.5, 1e-7);
    EXPECT_TRUE(std::isnan(m.trains[2].interval_s)) << "the last train has no next";
    EXPECT_NEAR(m.trains[0].amplitude, 40, 0.05);
}

TEST(Trains, AreGroupedByAStatedGapWhichWinsOverTheRate) {
    EXPECT_EQ(measureChannel(longRecord(), 0, {.trainGap = Seconds(0.02)}).trains.size(), 3U);
    EXPECT_EQ(measureChannel(longRecord(), 0, {.intraTrainRate = Hertz(100), .trainGap = Seconds(1)}).trains.size(),
              1U);
    EXPECT_EQ(measureChannel(longRecord(), 0, {.intraTrainRate = Hertz(200)}).trains.size(), 9U)
        << "7.5 ms is too near";
}

std::vector<Capture> shortCaptures(const std::vector<double>& onsets) {
    std::vector<Capture> captures;
    unsigned seed = 1;
    for (const double onset : onsets) {
        captures.push_back(recordOf(
            biphasic(onset), {.start_s = onset - 1e-3 + 1e-7 * seed, .samples = 6000, .noise = 0.1, .seed = seed}));
        ++seed;
    }
    return captures;
}

TEST(Trains, ShortCapturesGiveIntervalsFromTheirTimeStamps) {
    const auto captures = shortCaptures({100.0, 100.5, 101.0003, 103});
    const auto m = measureTrains(captures, "voltage").value();
    ASSERT_EQ(m.trains.size(), 4U);
    EXPECT_NEAR(m.trains[0].interval_s, 0.5, 1e-7);
    EXPECT_NEAR(m.trains[1].interval_s, 0.5003, 1e-7);
    EXPECT_NEAR(m.trains[2].interval_s, 1.9997, 1e-7);
    EXPECT_EQ(m.interval_s.n, 3U);
    EXPECT_EQ(m.samples, 24'000U);
    EXPECT_TRUE(m.warnings.empty()) << m.warnings[0];
}

TEST(Trains, AnEmptyCaptureBreaksTheIntervalAcrossIt) {
    RecordProperty("hazard", "H9");
    auto captures = shortCaptures({1, 2, 3, 4});
    for (float& x : captures[1].channels[0].samples) x = 0;
    const auto m = measureTrains(captures, "voltage").value();
    ASSERT_EQ(m.trains.size(), 3U);
    EXPECT_EQ(m.interval_s.n, 1U) << "from 1 s to 3 s would be two intervals";
    EXPECT_NEAR(m.interval_s.mean, 1, 1e-7);
    ASSERT_EQ(m.warnings.size(), 1U);
    EXPECT_NE(m.warnings[0].find("no pulses in 1 of 4 captures"), std::string::npos) << m.warnings[0];
}

TEST(Trains, CapturesThatShareNoTimeBaseGiveNoInterval) {
    RecordProperty("hazard", "H9");
    auto captures = shortCaptures({1, 1});  // both stamps say 1 s
    const auto m = measureTrains(captures, "voltage").value();
    EXPECT_EQ(m.trains.size(), 2U);
    EXPECT_EQ(m.interval_s.n, 0U);
    ASSERT_EQ(m.warnings.size(), 1U);
}

TEST(Trains, AllCapturesEmptyIsAWarningAndNoNumber) {
    RecordProperty("hazard", "H9");
    auto captures = shortCaptures({1, 2});
    for (auto& capture : captures) {
        for (float& x : capture.channels[0].samples) x = 0;
    }
    const auto m = measureTrains(captures, "voltage").value();
    EXPECT_EQ(m.measuredPulses, 0U);
    EXPECT_TRUE(std::isnan(m.amplitude.mean));
    EXPECT_EQ(m.warnings.size(), 1U);
}

TEST(Trains, RefusesNoCapturesAndAnUnknownChannel) {
    EXPECT_EQ(measureTrains({}, "voltage").error().code, ErrorCode::InvalidArgument);
    const auto unknown = measureTrains(shortCaptures({1}), "current");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().code, ErrorCode::NotFound);
    EXPECT_EQ(unknown.error().message, "no channel 'current'; the capture has voltage");
}

}  // namespace
}  // namespace tacto::test
