// Faulty boards and lines: losses are counted exactly and stay gaps, nonsense is refused in one sentence, and nothing
// makes the host wait or use more memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "core/acquisition/StreamHealth.h"
#include "tests/drivers/sensor_board/SensorBoardBench.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace sensorboard;
using sensorboard::Command;
using testing::HasSubstr;

/// Calls `what` with the board.
template <class What>
void with(SensorBoardBench& bench, What&& what) {
    bench.line->inspect([&](EmulatedBoard& board, Instant now) {
        what(board, now);
        return 0;
    });
}

EmulatedBoard::Fate fateOf(SensorBoardBench& bench, std::size_t stream) {
    return bench.line->inspect([&](EmulatedBoard& board, Instant) { return board.fate(stream); });
}

/// Expects the losses of every stream to equal the board's own counts.
void expectExactCounts(SensorBoardBench& bench) {
    const auto report = bench.board->report();
    for (std::size_t s = 0; s < EmulatedBoard::kStreams; ++s) {
        const auto fate = fateOf(bench, s);
        EXPECT_EQ(report.streams[s].lostBlocks, fate.lost) << "stream " << s;
        EXPECT_EQ(report.streams[s].lostSamples, fate.lostSamples) << "stream " << s;
        EXPECT_EQ(report.streams[s].late, fate.late) << "stream " << s;
        EXPECT_EQ(report.streams[s].unsound, 0U);
    }
}

TEST(SensorBoardFaults, LostSpoiltSwappedAndRepeatedBlocksAreCountedExactly) {
    RecordProperty("hazard", "H7");
    EmulatedBoardSettings settings;
    settings.flaws = {0.02, 0.02, 0.02, 0.02};
    SensorBoardBench bench(settings);
    bench.openFor(Seconds(20));
    with(bench, [](EmulatedBoard& board, Instant) { board.spoil({}); });
    ASSERT_TRUE(bench.run(Seconds(0.2)).has_value());  // long enough for a block to follow the last lost one
    expectExactCounts(bench);
    EXPECT_GT(fateOf(bench, 0).lost, 50U);
    EXPECT_GT(fateOf(bench, 0).late, 50U);
    EXPECT_GE(bench.board->report().line.bad(), fateOf(bench, 0).flipped);

    // Every sample is where its number says; a missing sample is a gap in the stamps.
    const auto& acceleration = bench.blocks[0];
    std::int64_t missing = 0;
    for (std::size_t i = 1; i < acceleration.samples(); ++i) {
        const auto steps = stepOf(acceleration, i) - stepOf(acceleration, i - 1);
        ASSERT_GE(steps, 1);
        ASSERT_NEAR(acceleration.t_s[i] - acceleration.t_s[i - 1], static_cast<double>(steps) / 4000, 60e-6);
        missing += steps - 1;
    }
    EXPECT_EQ(missing + stepOf(acceleration, 0), static_cast<std::int64_t>(fateOf(bench, 0).lostSamples));
    StreamHealth health(4000);
    health.feed(acceleration, 3);
    const auto lead = stepOf(acceleration, 0) > 0 ? 1U : 0U;
    EXPECT_EQ(health.report().gaps + lead, bench.board->report().streams[0].gaps);
}

TEST(SensorBoardFaults, OneLostBlockIsOneGap) {
    RecordProperty("hazard", "H7");
    SensorBoardBench bench;
    bench.openFor(Seconds(0.5));
    with(bench, [](EmulatedBoard& board, Instant) { board.dropNext(0); });
    ASSERT_TRUE(bench.run(Seconds(0.5)).has_value());
    const auto counts = bench.board->report().streams[0];
    EXPECT_EQ(counts.gaps, 1U);
    EXPECT_EQ(counts.lostBlocks, 1U);
    EXPECT_EQ(counts.lostSamples, 32U);
    EXPECT_EQ(bench.board->report().streams[1].gaps, 0U);
}

TEST(SensorBoardFaults, SamplesThatTheBoardCouldNotFetchAreAGapToo) {
    RecordProperty("hazard", "H7");
    SensorBoardBench bench;
    bench.openFor(Seconds(0.5));
    with(bench, [](EmulatedBoard& board, Instant) { board.overrun(0, 37); });
    ASSERT_TRUE(bench.run(Seconds(1.5)).has_value());
    const auto report = bench.board->report();
    EXPECT_EQ(report.streams[0].lostSamples, 37U);
    EXPECT_EQ(report.streams[0].lostBlocks, 0U);
    EXPECT_EQ(report.streams[0].gaps, 1U);
    EXPECT_EQ(report.board.samplesLost, 37U) << "the board says so itself";
}

TEST(SensorBoardFaults, AHostThatDoesNotReadLosesBlocksAndIsTold) {
    RecordProperty("hazard", "H7");
    EmulatedBoardSettings settings;
    settings.bufferBytes = 8192;
    SensorBoardBench bench(settings);
    bench.openFor(Seconds(0.5));
    ASSERT_TRUE(bench.run(Seconds(10), Seconds(10)).has_value());
    ASSERT_TRUE(bench.run(Seconds(2)).has_value());
    expectExactCounts(bench);
    const auto report = bench.board->report();
    EXPECT_GT(report.streams[0].lostBlocks, 1000U);
    EXPECT_EQ(report.board.blocksDropped,
              report.streams[0].lostBlocks + report.streams[1].lostBlocks + report.streams[2].lostBlocks);
}

TEST(SensorBoardFaults, UnpluggedInMidStreamAndOpenedAnewWhenItIsBack) {
    RecordProperty("hazard", "H2");
    SensorBoardBench bench;
    bench.openFor(Seconds(0.5));
    bench.line->unplug();
    EXPECT_THAT(bench.run(Seconds(0.01)),
                refused(ErrorCode::Device, "emulated sensor board: the emulated sensor board is unplugged"));
    bench.line->plug();
    EXPECT_FALSE(bench.board->read(bench.blocks).has_value()) << "an old device stays useless";
    bench.open();
    EXPECT_TRUE(bench.run(Seconds(0.1)).has_value());
}

TEST(SensorBoardFaults, GarbageInMidStreamIsRefusedWithinASecond) {
    RecordProperty("hazard", "H7");
    SensorBoardBench bench;
    bench.openFor(Seconds(0.5));
    with(bench, [](EmulatedBoard& board, Instant) { board.talkGarbage(true); });
    const auto samples = bench.blocks[0].samples();
    const auto begin = bench.clock.now();
    EXPECT_THAT(bench.run(Seconds(60)), refused(ErrorCode::Device, "it sends garbage:"));
    EXPECT_LT(bench.clock.now() - begin, std::chrono::seconds(1));
    EXPECT_LE(bench.blocks[0].samples() - samples, 64U) << "only what was on its way";
}

TEST(SensorBoardFaults, AMomentOfGarbageIsOnlyAGap) {
    RecordProperty("hazard", "H7");
    SensorBoardBench bench;
    bench.openFor(Seconds(0.5));
    with(bench, [](EmulatedBoard& board, Instant) { board.talkGarbage(true); });
    ASSERT_TRUE(bench.run(Seconds(0.1)).has_value());
    with(bench, [](EmulatedBoard& board, Instant) { board.talkGarbage(false); });
    ASSERT_TRUE(bench.run(Seconds(5)).has_value());
    const auto report = bench.board->report();
    EXPECT_EQ(report.streams[0].gaps, 1U);
    EXPECT_NEAR(static_cast<double>(report.streams[0].lostBlocks), 12.5, 2);
    EXPECT_GT(report.line.bad(), 0U);
}

/// Endless noise: fills every read, and each read takes a millisecond.
class NoiseTransport final : public Transport {
public:
    explicit NoiseTransport(VirtualClock& clock) : clock_(clock) {}
    Result<void> write(std::span<const std::uint8_t>, Seconds) override { return {}; }
    Result<std::size_t> read(std::span<std::uint8_t> into, Seconds) override {
        for (auto& byte : into) byte = static_cast<std::uint8_t>(engine_());
        given += into.size();
        clock_.advanceTo(clock_.now() + std::chrono::milliseconds(1));
        return into.size();
    }
    std::uint64_t dropped() const noexcept override { return 0; }
    void writeUrgent(std::span<const std::uint8_t>) noexcept override {}

    std::uint64_t given = 0;

private:
    VirtualClock& clock_;
    std::mt19937 engine_{3};
};

TEST(SensorBoardFaults, ADeviceThatAnswersGarbageIsNotOpened) {
    RecordProperty("hazard", "H10");
    VirtualClock clock;
    auto noise = std::make_unique<NoiseTransport>(clock);
    EXPECT_THAT(SensorBoard::open(std::move(noise), {}, clock),
                refused(ErrorCode::Device, "it answers HELLO with garbage:"));
    EXPECT_LT(clock.now(), std::chrono::seconds(2));
}

/// A line that turns to endless noise when told to.
class TurningTransport final : public Transport {
public:
    TurningTransport(std::unique_ptr<Transport> sound, VirtualClock& clock) : sound_(std::move(sound)), noise_(clock) {}
    Result<void> write(std::span<const std::uint8_t> b, Seconds t) override { return sound_->write(b, t); }
    Result<std::size_t> read(std::span<std::uint8_t> into, Seconds t) override {
        return turned ? noise_.read(into, t) : sound_->read(into, t);
    }
    std::uint64_t dropped() const noexcept override { return 0; }
    void writeUrgent(std::span<const std::uint8_t> b) noexcept override { sound_->writeUrgent(b); }
    [[nodiscard]] std::uint64_t noise() const noexcept { return noise_.given; }

    bool turned = false;

private:
    const std::unique_ptr<Transport> sound_;
    NoiseTransport noise_;
};

TEST(SensorBoardFaults, AMinuteOfNoiseWithoutEndStaysBounded) {
    RecordProperty("hazard", "H10");
    SensorBoardBench bench;
    auto transport = accepted(bench.line->connect());
    auto owned = std::make_unique<TurningTransport>(std::move(transport), bench.clock);
    auto& turning = *owned;
    auto board = accepted(SensorBoard::open(std::move(owned), {}, bench.clock));
    std::vector<SampleBlock> blocks(3);
    ASSERT_TRUE(board->read(blocks).has_value());
    turning.turned = true;
    const auto begin = bench.clock.now();
    bool refused = false;
    for (const auto end = begin + std::chrono::minutes(1); bench.clock.now() < end;) {
        const auto before = turning.noise();
        const auto read = board->read(blocks);
        ASSERT_LE(turning.noise() - before, SensorBoard::kMaxRead + 4096) << "of one read()";
        if (!read) {
            EXPECT_THAT(read.error().message, HasSubstr("garbage"));
            if (!refused) {
                EXPECT_LT(bench.clock.now() - begin, std::chrono::seconds(1));
            }
            refused = true;
            bench.clock.advanceTo(bench.clock.now() + std::chrono::milliseconds(2));
        }
    }
    EXPECT_TRUE(refused);
    for (const auto& block : blocks) EXPECT_LT(block.values.capacity(), 10'000U);
}

TEST(SensorBoardFaults, ABoardThatBeganAgainIsRefused) {
    RecordProperty("hazard", "H7");
    SensorBoardBench bench;
    bench.openFor(Seconds(2));
    with(bench, [](EmulatedBoard& board, Instant now) { board.restart(now); });
    EXPECT_THAT(bench.run(Seconds(1)), refusedSaying("it began again: 8 blocks"));
}

TEST(SensorBoardFaults, AClockThatJumpsAheadIsRefused) {
    RecordProperty("hazard", "H7");
    SensorBoardBench bench;
    bench.openFor(Seconds(2));
    with(bench, [](EmulatedBoard& board, Instant) { board.jumpClock(Seconds(2)); });
    EXPECT_THAT(bench.run(Seconds(1)), refusedSaying("its clock jumped ahead by 2 s"));
}

TEST(SensorBoardFaults, AClockThatRunsThreePercentFastIsRefused) {
    RecordProperty("hazard", "H7");
    EmulatedBoardSettings settings;
    settings.drift_ppm = 30'000;
    SensorBoardBench bench(settings);
    bench.open();
    EXPECT_THAT(bench.run(Seconds(30)), refusedSaying("its clock runs +3.00 % wrong; ± 1 % at most was expected"));
}

TEST(SensorBoardFaults, AnotherVersionOfTheProtocolIsRefused) {
    RecordProperty("hazard", "H4");
    EmulatedBoardSettings settings;
    settings.lowestVersion = 3;
    settings.highestVersion = 4;
    SensorBoardBench bench(settings);
    EXPECT_THAT(bench.tryOpen(),
                refused(ErrorCode::Unsupported, testing::Eq("sensor board \"sensor:\": it speaks versions 3 to 4 of "
                                                            "the sensor board protocol; version 1 or 2 was expected")));
}

TEST(SensorBoardFaults, ADoneOfAnotherCommandIsNotTakenForThisOne) {
    RecordProperty("hazard", "H4");
    EmulatedBoardSettings settings;
    settings.done = static_cast<std::uint8_t>(Command::Start);  // also sent for STOP, the first command
    SensorBoardBench bench(settings);
    EXPECT_THAT(bench.tryOpen(), refused(ErrorCode::Device, "it says that it has done command"));
}

TEST(SensorBoardFaults, WrongUnitsAreRefused) {
    RecordProperty("hazard", "H4");
    EmulatedBoardSettings settings;
    settings.unit = TSB_UNIT_PASCAL;
    SensorBoardBench bench(settings);
    EXPECT_THAT(bench.tryOpen(),
                refusedSaying(testing::Eq(
                    "sensor board \"sensor:\": its acceleration stream is in Pa; m/s2 or count was expected")));
}

TEST(SensorBoardFaults, AnotherBoardThanTheOneNamedIsRefused) {
    RecordProperty("hazard", "H4");
    SensorBoardBench bench;
    EXPECT_THAT(bench.tryOpen({"sensor:TSB-7", "TSB-7"}),
                refused(ErrorCode::NotFound, "its serial number is \"EMU-0001\"; \"TSB-7\" was expected"));
}

TEST(SensorBoardFaults, ABoardThatSaysNothingIsNotWaitedForLong) {
    SensorBoardBench bench;
    with(bench, [](EmulatedBoard& board, Instant) { board.fallSilent(); });
    const auto begin = bench.clock.now();
    EXPECT_THAT(bench.tryOpen(), refused(ErrorCode::Timeout, "it does not answer HELLO within 0.3 s"));
    EXPECT_NEAR(toSeconds(bench.clock.now() - begin), 0.9, 0.01) << "three attempts";
}

}  // namespace
}  // namespace tacto::test
