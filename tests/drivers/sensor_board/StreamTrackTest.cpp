// One stream: losses are counted to the block and sample, raw numbers become values, nonsense is not used.
#include <gtest/gtest.h>

#include "drivers/sensor_board/StreamTrack.h"

namespace tacto::test {
namespace {

using namespace sensorboard;
using Verdict = StreamTrack::Verdict;

constexpr std::uint32_t kInterval_ns = 250'000;

StreamConfiguration configuration(SampleFormat format = SampleFormat::Int16, std::size_t columns = 1) {
    StreamConfiguration made{0,         true, StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, format,
                             4'000'000, {}};
    for (std::size_t i = 0; i < columns; ++i) made.columns.push_back({0.5, static_cast<double>(i)});
    return made;
}

/// Makes blocks of four samples of a flawless stream.
class Source {
public:
    DataBlock at(std::uint32_t n) {
        bytes_.assign(8, 0);
        DataBlock block;
        block.count = 4;
        block.sequence = n;
        block.index = 4 * n;
        block.time_us = 1000 + 1000ULL * n;
        block.interval_ns = kInterval_ns;
        block.samples = bytes_;
        return block;
    }

private:
    std::vector<std::uint8_t> bytes_;
};

TEST(SensorBoardStream, CountsWhatIsMissingToTheBlockAndSample) {
    RecordProperty("hazard", "H7");
    StreamTrack track(configuration());
    Source source;
    for (const std::uint32_t n : {0U, 1U, 2U, 5U, 6U, 10U, 11U}) EXPECT_EQ(track.take(source.at(n)), Verdict::Next);
    EXPECT_EQ(track.counts().gaps, 2U);
    EXPECT_EQ(track.counts().lostBlocks, 5U);
    EXPECT_EQ(track.counts().lostSamples, 20U);
    EXPECT_EQ(track.counts().blocks, 7U);
    EXPECT_EQ(track.counts().samples, 28U);
}

TEST(SensorBoardStream, CountsWhatIsMissingBeforeTheFirst) {
    StreamTrack track(configuration());
    Source source;
    EXPECT_EQ(track.take(source.at(3)), Verdict::Next);
    EXPECT_EQ(track.counts().lostBlocks, 3U);
    EXPECT_EQ(track.counts().lostSamples, 12U);
}

TEST(SensorBoardStream, TellsSamplesThatTheBoardDidNotFetchFromLostBlocks) {
    StreamTrack track(configuration());
    Source source;
    EXPECT_EQ(track.take(source.at(0)), Verdict::Next);
    auto block = source.at(1);
    block.index += 7;
    block.time_us += 1750;
    EXPECT_EQ(track.take(block), Verdict::Next);
    EXPECT_EQ(track.counts().lostBlocks, 0U);
    EXPECT_EQ(track.counts().lostSamples, 7U);
    EXPECT_EQ(track.counts().gaps, 1U);
}

TEST(SensorBoardStream, ARepeatedOrLateBlockIsNotUsed) {
    RecordProperty("hazard", "H7");
    StreamTrack track(configuration());
    Source source;
    for (const std::uint32_t n : {0U, 1U}) EXPECT_EQ(track.take(source.at(n)), Verdict::Next);
    EXPECT_EQ(track.take(source.at(1)), Verdict::Late);
    EXPECT_EQ(track.take(source.at(3)), Verdict::Next);
    EXPECT_EQ(track.take(source.at(2)), Verdict::Late);
    EXPECT_EQ(track.counts().late, 2U);
    EXPECT_EQ(track.counts().lostBlocks, 1U);
    EXPECT_EQ(track.lateInARow(), 1U);
}

TEST(SensorBoardStream, NumbersMayWrap) {
    StreamTrack track(configuration());
    Source source;
    EXPECT_EQ(track.take(source.at(0)), Verdict::Next);
    // Advances by almost half the number range twice, as after a very long gap, then past the end of the range.
    auto block = source.at(0x70000000U);
    block.index = 0x70000000U;
    EXPECT_EQ(track.take(block), Verdict::Next);
    block.sequence = block.index = 0xE0000000U;
    block.time_us += 1'000'000'000;
    EXPECT_EQ(track.take(block), Verdict::Next);
    const auto before = track.counts();
    block.sequence = 0xFFFFFFFFU;
    block.index = 0xFFFFFFFCU;
    block.time_us += 1'000'000'000;
    EXPECT_EQ(track.take(block), Verdict::Next);
    block.sequence = 1;  // one block is missing
    block.index = 4;
    block.time_us += 2000;
    EXPECT_EQ(track.take(block), Verdict::Next);
    EXPECT_EQ(track.counts().lostBlocks - before.lostBlocks, 0x1FFFFFFEU + 1U);
    EXPECT_EQ(track.counts().late, 0U);
}

TEST(SensorBoardStream, WhatContradictsItselfIsNotUsedAndIsMissing) {
    RecordProperty("hazard", "H7");
    Source source;
    const auto unsound = [&](auto&& change) {
        StreamTrack track(configuration());
        EXPECT_EQ(track.take(source.at(0)), Verdict::Next);
        auto block = source.at(1);
        change(block);
        EXPECT_EQ(track.take(block), Verdict::Unsound);
        EXPECT_EQ(track.take(source.at(2)), Verdict::Next);
        EXPECT_EQ(track.counts().unsound, 1U);
        EXPECT_EQ(track.counts().lostBlocks, 1U);
        EXPECT_EQ(track.counts().lostSamples, 4U);
    };
    unsound([](DataBlock& b) { b.count = 5; });
    unsound([](DataBlock& b) { b.samples = b.samples.first(7); });
    unsound([](DataBlock& b) { b.interval_ns = 200'000; });
    unsound([](DataBlock& b) { b.interval_ns = 0; });
    unsound([](DataBlock& b) { b.interval_ns = 300'000; });
    unsound([](DataBlock& b) { b.time_us = 1000; });
    unsound([](DataBlock& b) { b.time_us = ~std::uint64_t{0}; });
    unsound([](DataBlock& b) { b.index = 2; });
}

TEST(SensorBoardStream, IntervalsWithinTenPercentAreTheBoardsToMeasure) {
    StreamTrack track(configuration());
    Source source;
    auto block = source.at(0);
    block.interval_ns = 274'000;
    EXPECT_EQ(track.take(block), Verdict::Next);
}

TEST(SensorBoardStream, NumbersBecomeValues) {
    RecordProperty("hazard", "H4");
    ClockFit clock;
    clock.observe(2000, toInstant(10));
    const auto timeOf = [&](double us) { return clock.toSession(us); };
    DataBlock block;
    block.count = 2;
    block.time_us = 1750;
    block.interval_ns = kInterval_ns;
    const std::vector<std::uint8_t> narrow{0x01, 0x00, 0xFF, 0xFF, 0x00, 0x80, 0xFF, 0x7F};
    block.samples = narrow;
    StreamTrack two(configuration(SampleFormat::Int16, 2));
    ASSERT_EQ(two.take(block), Verdict::Next);
    SampleBlock into;
    two.append(block, timeOf, into);
    EXPECT_EQ(into.values, (std::vector<double>{0.5, 0.5, -16384, 16384.5}));
    ASSERT_EQ(into.t_s.size(), 2U);
    EXPECT_NEAR(into.t_s[0], 10 - 250e-6, 1e-9);
    EXPECT_NEAR(into.t_s[1], 10, 1e-9);

    const std::vector<std::uint8_t> wide{0x00, 0x00, 0x00, 0x80, 0xFF, 0xFF, 0xFF, 0x7F};
    block.samples = wide;
    StreamTrack one(configuration(SampleFormat::Int32, 1));
    ASSERT_EQ(one.take(block), Verdict::Next);
    one.append(block, timeOf, into);
    EXPECT_EQ(into.values.size(), 6U) << "appended";
    EXPECT_EQ(into.values[4], -1073741824.0);
    EXPECT_EQ(into.values[5], 1073741823.5);
}

}  // namespace
}  // namespace tacto::test
