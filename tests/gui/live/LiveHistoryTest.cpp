// What the live plots remember: bounded, in order, and nothing of another bench.
#include <cmath>
#include <gtest/gtest.h>

#include "app/gui/live/LiveHistory.h"

namespace tacto::test {
namespace {

using gui::LiveHistory;
using gui::Series;
using gui::TrainRing;

const std::vector<StreamInfo> kStreams{{StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 3, 4000, "a"},
                                       {StreamKind::Force, StreamUnit::Newton, 1, 200, "f"}};

TapSample sampleAt(double t_s, std::uint32_t stream, float value) {
    TapSample sample;
    sample.t_s = t_s;
    sample.stream = stream;
    sample.channels = stream == 0 ? 3 : 1;
    sample.values.fill(value);
    return sample;
}

Telemetry at(double t_s) {
    Telemetry telemetry;
    telemetry.at = toInstant(t_s);
    return telemetry;
}

TEST(Series, KeepsTheNewestInOrder) {
    Series series(2, 5);
    for (int i = 0; i < 12; ++i) series.push(i, std::array{float(i), float(-i)});
    ASSERT_EQ(series.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_DOUBLE_EQ(series.time(i), 7.0 + double(i));
        EXPECT_FLOAT_EQ(series.value(i, 0), 7.F + float(i));
        EXPECT_FLOAT_EQ(series.value(i, 1), -7.F - float(i));
    }
    EXPECT_EQ(series.firstFrom(8.5), 2U);
    EXPECT_EQ(series.firstFrom(100), 5U);
}

TEST(Series, AChannelThatWasNotSentIsAbsent) {
    Series series(3, 4);
    series.push(1, std::array{5.F});
    EXPECT_FLOAT_EQ(series.value(0, 0), 5.F);
    EXPECT_TRUE(std::isnan(series.value(0, 2)));
}

TEST(Series, LeavesOutRepeatsAndBeginsAnewOnAnotherClock) {
    Series series(1, 10);
    for (const double t : {10.0, 10.1, 10.1, 10.05, std::nan(""), 10.2}) series.push(t, std::array{float(t)});
    ASSERT_EQ(series.size(), 3U);
    EXPECT_DOUBLE_EQ(series.newest(), 10.2);
    series.push(2.0, std::array{2.F});
    ASSERT_EQ(series.size(), 1U);
    EXPECT_DOUBLE_EQ(series.newest(), 2.0);
}

TEST(TrainRing, ForgetsTheOldest) {
    TrainRing trains;
    for (std::size_t i = 0; i < TrainRing::kCapacity + 30; ++i) {
        TrainReport report;
        report.amplitude = double(i);
        trains.push(report);
    }
    ASSERT_EQ(trains.size(), TrainRing::kCapacity);
    EXPECT_DOUBLE_EQ(trains[0].amplitude, 30);
    EXPECT_DOUBLE_EQ(trains.back().amplitude, double(TrainRing::kCapacity) + 29);
}

TEST(LiveHistory, IsBoundedToAMinute) {
    LiveHistory history;
    history.begin(kStreams);
    BenchTap tap;
    for (int second = 0; second < 100; ++second) {
        for (int i = 0; i < 4000; ++i) tap.samples.push(sampleAt(second + i / 4000.0, 0, float(second)));
        for (int i = 0; i < 70; ++i) {
            RoughnessFrame frame;
            frame.t_s = second + i / 70.0;
            tap.frames.push(frame);
            history.take(tap, at(frame.t_s));
        }
    }
    const auto& acceleration = *history.samples(StreamKind::Acceleration);
    EXPECT_EQ(acceleration.size(), std::size_t(4000 * LiveHistory::kKept_s));
    EXPECT_EQ(acceleration.size(), acceleration.capacity());
    EXPECT_NEAR(acceleration.newest() - acceleration.time(0), LiveHistory::kKept_s, 0.01);
    EXPECT_EQ(history.frames().size(), std::min<std::size_t>(7000, history.frames().capacity()));
    EXPECT_LE(history.commands().size(), history.commands().capacity());
    EXPECT_EQ(history.missed(), 0U);
}

TEST(LiveHistory, SaysWhatTheDisplayLeftOut) {
    LiveHistory history;
    history.begin(kStreams);
    BenchTap tap;
    const auto room = tap.samples.capacity();
    for (std::size_t i = 0; i < room + 50; ++i) tap.samples.push(sampleAt(double(i) / 4000, 0, 0));
    history.take(tap, at(5));
    EXPECT_EQ(history.missed(), 50U);
    EXPECT_EQ(history.samples(StreamKind::Acceleration)->size(), room);
}

TEST(LiveHistory, KeepsTheCommandOverTime) {
    LiveHistory history;
    history.begin(kStreams);
    BenchTap tap;
    auto telemetry = at(1);
    history.take(tap, telemetry);
    telemetry = at(2);
    telemetry.amplitude_v = 25;
    telemetry.interval_s = 0.5;
    telemetry.impedance_ohm = 1000;
    history.take(tap, telemetry);
    ASSERT_EQ(history.commands().size(), 2U);
    EXPECT_TRUE(std::isnan(history.commands().value(0, LiveHistory::kAmplitude_v)));
    EXPECT_FLOAT_EQ(history.commands().value(1, LiveHistory::kAmplitude_v), 25);
    EXPECT_FLOAT_EQ(history.commands().value(1, LiveHistory::kInterval_s), 0.5F);
    EXPECT_FLOAT_EQ(history.commands().value(1, LiveHistory::kImpedance_ohm), 1000);
}

TEST(LiveHistory, AnotherBenchLeavesNothingOfTheOneBefore) {
    LiveHistory history;
    history.begin(kStreams);
    BenchTap tap;
    tap.samples.push(sampleAt(1, 1, 3));
    tap.trains.push(TrainReport{});
    tap.frames.push(RoughnessFrame{});
    history.take(tap, at(1));
    ASSERT_EQ(history.trains().size(), 1U);
    history.begin({kStreams.back()});
    EXPECT_EQ(history.samples(StreamKind::Acceleration), nullptr);
    EXPECT_TRUE(history.samples(StreamKind::Force)->empty());
    EXPECT_TRUE(history.frames().empty());
    EXPECT_TRUE(history.commands().empty());
    EXPECT_TRUE(history.trains().empty());
    EXPECT_EQ(history.now_s(), 0);
}

}  // namespace
}  // namespace tacto::test
