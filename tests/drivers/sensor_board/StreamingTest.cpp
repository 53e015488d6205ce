// A board in order: delivers every sample once, with its value and time, for ten minutes; its statements are read back;
// and the control loop uses its data.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/acquisition/StreamHealth.h"
#include "core/bench/sensing/FingerInput.h"
#include "tests/drivers/sensor_board/SensorBoardBench.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace sensorboard;

TEST(SensorBoard, SaysWhatItIs) {
    SensorBoardBench bench;
    bench.open({.uri = "sensor:EMU-0001", .serial = "EMU-0001"});
    const auto& identity = bench.board->identity();
    EXPECT_EQ(identity.uri, "sensor:EMU-0001");
    EXPECT_EQ(identity.role, Role::Sensor);
    EXPECT_EQ(identity.name, "emulated sensor board");
    EXPECT_EQ(identity.serial, "EMU-0001");
    EXPECT_EQ(identity.firmware, TACTOSCOPE_VERSION);
    EXPECT_FALSE(identity.simulated) << "its word does not count";
    const auto streams = bench.board->streams();
    ASSERT_EQ(streams.size(), 3U);
    EXPECT_EQ(streams[0].kind, StreamKind::Acceleration);
    EXPECT_EQ(streams[0].rate_hz, 4000);
    EXPECT_EQ(streams[0].unit, StreamUnit::MetrePerSecondSquared);
    EXPECT_EQ(streams[1].kind, StreamKind::Taxels);
    EXPECT_EQ(streams[1].channels, 8U);
    EXPECT_EQ(streams[2].kind, StreamKind::Force);
    EXPECT_EQ(streams[2].rate_hz, 200);
    ASSERT_EQ(bench.board->calibrations().size(), 3U);
    EXPECT_EQ(bench.board->calibrations()[0].date, "2026-11-20");
    EXPECT_TRUE(bench.board->calibrations()[2].calibrated);
}

TEST(SensorBoard, IsSimulatedWhereTheAddressSaysSoAndItAgrees) {
    testing::Test::RecordProperty("hazard", "H9");
    SensorBoardBench emulated;
    emulated.open({.uri = "sensor:?emulated=yes", .emulated = true});
    EXPECT_TRUE(emulated.board->identity().simulated);
    EmulatedBoardSettings another;
    another.serial = "TSB-0001";
    SensorBoardBench real;
    real.line = std::make_shared<EmulatedBoardLine>(real.clock, &real.clock, another);
    EXPECT_THAT(real.tryOpen({.uri = "sensor:?emulated=yes", .emulated = true}),
                refusedSaying("\"TSB-0001\", and the address says emulated=yes"));
}

TEST(SensorBoard, GivesEverySampleOnceWithItsValueAndTime) {
    RecordProperty("hazard", "H7");
    EmulatedBoardSettings settings;
    settings.wideForce = true;
    SensorBoardBench bench(settings);
    bench.openFor(Seconds(10));
    const auto& acceleration = bench.blocks[0];
    ASSERT_GT(acceleration.samples(), 39'000U);
    for (std::size_t i = 0; i < acceleration.samples(); ++i) {
        ASSERT_EQ(stepOf(acceleration, i), static_cast<std::int64_t>(i));
        if (i > 0) {
            ASSERT_NEAR(acceleration.t_s[i] - acceleration.t_s[i - 1], 250e-6, 5e-6);
        }
        ASSERT_NEAR(acceleration.values[3 * i + 2], 9.80665, CountingSignal::kAcceleration);
    }
    for (std::size_t i = 0; i < bench.blocks[1].samples(); ++i) {
        for (std::size_t taxel = 0; taxel < 8; ++taxel) {
            ASSERT_EQ(bench.blocks[1].values[8 * i + taxel],
                      (static_cast<double>(20 * i % 1000) + static_cast<double>(taxel)) * CountingSignal::kPressure);
        }
    }
    for (std::size_t i = 0; i < bench.blocks[2].samples(); ++i) {
        ASSERT_NEAR(bench.blocks[2].values[i], static_cast<double>(20 * i % 1000) * CountingSignal::kForce, 1e-7);
        ASSERT_NEAR(bench.blocks[2].t_s[i], acceleration.t_s[20 * i], 20e-6) << "one moment, one stamp";
    }
}

TEST(SensorBoard, TenMinutesWithNothingLostAndTheDriftKnownToOnePartPerMillion) {
    RecordProperty("hazard", "H7");
    EmulatedBoardSettings settings;
    settings.drift_ppm = 50;
    settings.jitter = Seconds(1e-3);
    SensorBoardBench bench(settings);
    bench.open();
    std::array<StreamHealth, 3> health{StreamHealth(4000), StreamHealth(200), StreamHealth(200)};
    std::uint64_t samples = 0;
    for (int second = 0; second < 600; ++second) {
        const auto read = bench.run(Seconds(1), Seconds(0.25e-3));  // reads as often as a listening thread would
        ASSERT_TRUE(read.has_value()) << read.error().message;
        for (std::size_t s = 0; s < 3; ++s) {
            health[s].feed(bench.blocks[s], bench.board->streams()[s].channels);
            if (s == 0) samples += bench.blocks[s].samples();
            bench.blocks[s].clear();
        }
    }
    const auto report = bench.board->report();
    EXPECT_NEAR(static_cast<double>(samples), 600 * 4000 * (1 + 50e-6), 100);
    for (std::size_t s = 0; s < 3; ++s) {
        EXPECT_TRUE(health[s].report().continuous()) << health[s].report().text();
        EXPECT_EQ(report.streams[s].lostBlocks + report.streams[s].lostSamples + report.streams[s].late, 0U);
        EXPECT_EQ(report.streams[s].gaps, 0U);
    }
    EXPECT_EQ(report.line.bad(), 0U);
    EXPECT_EQ(report.foreign, 0U);
    ASSERT_TRUE(report.driftKnown);
    EXPECT_NEAR(report.drift_ppm, 50, 1);
    EXPECT_LE(std::abs(report.drift_ppm - 50), report.driftUncertainty_ppm);
    EXPECT_LT(report.driftUncertainty_ppm, 1);
    EXPECT_GT(report.driftSpan_s, 300);
    EXPECT_TRUE(report.board.running);
    // Data are at least as old as the line's delay.
    EXPECT_GT(report.delayMost_s, 300e-6);
    EXPECT_LT(report.delayMost_s, 10e-3);
}

TEST(SensorBoard, NoGapIsSeenWhereNoneIsWhateverTheLineAndTheCrystal) {
    RecordProperty("hazard", "H7");
    for (const double drift : {-200.0, -50.0, 50.0, 200.0}) {
        for (const double jitter_s : {0.0, 0.1e-3, 0.5e-3, 1e-3}) {
            EmulatedBoardSettings settings;
            settings.drift_ppm = drift;
            settings.jitter = Seconds(jitter_s);
            settings.seed = 4;
            SensorBoardBench bench(settings);
            bench.open();
            ASSERT_TRUE(bench.run(Seconds(40), Seconds(0.00206)).has_value());
            for (std::size_t s = 0; s < 3; ++s) {
                StreamHealth health(bench.board->streams()[s].rate_hz);
                health.feed(bench.blocks[s], bench.board->streams()[s].channels);
                EXPECT_TRUE(health.report().continuous())
                    << drift << " ppm, " << jitter_s << " s, stream " << s << ": " << health.report().text();
            }
        }
    }
}

TEST(SensorBoard, StampsAreTrueWithinTheLinesDelay) {
    EmulatedBoardSettings settings;
    settings.drift_ppm = -80;
    settings.jitter = Seconds(0.2e-3);
    SensorBoardBench bench(settings);
    bench.open();
    const double begin_s = toSeconds(bench.clock.now());
    ASSERT_TRUE(bench.run(Seconds(60)).has_value());
    const auto& acceleration = bench.blocks[0];
    const std::size_t i = acceleration.samples() - 1;
    const double truth = begin_s + static_cast<double>(stepOf(acceleration, i)) / 4000 / (1 - 80e-6);
    // The host reads every 2 ms, which limits how well it knows the time.
    EXPECT_NEAR(acceleration.t_s[i], truth, bench.board->report().delayMost_s + 2.5e-3);
}

TEST(SensorBoard, TakesTheRatesThatItIsTold) {
    SensorBoardBench bench;
    SensorBoardSettings settings;
    settings.accelerationRate_hz = 2000;
    settings.slowRate_hz = 100;
    bench.open(settings);
    EXPECT_EQ(bench.board->streams()[0].rate_hz, 2000);
    EXPECT_EQ(bench.board->streams()[1].rate_hz, 100);
    EXPECT_EQ(bench.board->streams()[2].rate_hz, 100);
    EXPECT_EQ(bench.line->inspect([](EmulatedBoard& b, Instant) { return b.configuration(0).rate_mhz; }), 2'000'000U);
    ASSERT_TRUE(bench.run(Seconds(1)).has_value());
    EXPECT_NEAR(static_cast<double>(bench.blocks[0].samples()), 2000, 40);
    EXPECT_NEAR(static_cast<double>(bench.blocks[2].samples()), 100, 4);
}

TEST(SensorBoard, ARateThatItDoesNotHaveIsRefusedByIt) {
    SensorBoardBench bench;
    SensorBoardSettings settings;
    settings.accelerationRate_hz = 3333;
    EXPECT_THAT(bench.tryOpen(settings),
                refused(ErrorCode::Device,
                        "its acceleration stream cannot have 3333 Hz: it refuses SET_CONFIGURATION: it does "
                        "not support this value"));
}

TEST(SensorBoard, StopsTheBoardWhenItGoes) {
    SensorBoardBench bench;
    bench.open();
    const auto running = [](EmulatedBoard& board, Instant) { return board.running(); };
    EXPECT_TRUE(bench.line->inspect(running));
    bench.board.reset();
    EXPECT_FALSE(bench.line->inspect(running));
}

TEST(SensorBoard, OpensABoardThatAProgramLeftRunning) {
    SensorBoardBench bench;
    bench.openFor(Seconds(0.5));
    auto killed = std::move(bench.board);  // never sends STOP
    bench.clock.advanceTo(bench.clock.now() + std::chrono::seconds(1));
    bench.openFor(Seconds(0.5));
    EXPECT_EQ(bench.board->report().streams[0].lostBlocks, 0U);
    EXPECT_GT(bench.blocks[0].samples(), 1900U);
}

TEST(SensorBoard, FeedsTheControlLoopAndASilentBoardIsStaleWithinATenthOfASecond) {
    RecordProperty("hazard", "H7");
    EmulatedBoardSettings settings;
    SensorBoardBench bench;
    bench.line = std::make_shared<EmulatedBoardLine>(bench.clock, &bench.clock, settings);  // the simulated finger
    bench.open();
    auto session = accepted(SensorSession::create(*bench.board));
    auto input = accepted(FingerInput::create(*session, RoughnessSettings{}));
    const auto step = [&] {
        bench.clock.advanceTo(bench.clock.now() + std::chrono::milliseconds(2));
        (void)session->serve(bench.clock.now());
        input->update();
        return input->standing(toSeconds(bench.clock.now())) == FingerStanding::Fresh;
    };
    int fresh = 0;
    for (int i = 0; i < 2000; ++i) fresh += step() ? 1 : 0;
    EXPECT_GT(fresh, 1800);
    EXPECT_TRUE(step());
    EXPECT_EQ(input->gaps(), 0U);
    bench.line->inspect([](EmulatedBoard& board, Instant) {
        board.fallSilent();
        return 0;
    });
    for (int i = 0; i < 60; ++i) (void)step();
    EXPECT_FALSE(input->standing(toSeconds(bench.clock.now())) == FingerStanding::Fresh);
    EXPECT_FALSE(session->failed()) << "silence is judged by its age";
}

}  // namespace
}  // namespace tacto::test
