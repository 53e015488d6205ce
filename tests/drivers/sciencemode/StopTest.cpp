// forceOff() works from any thread, at any moment, without waiting for anything.
#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <thread>

#include "core/bench/delivery/StimulatorSession.h"
#include "tests/drivers/sciencemode/ScienceModeBench.h"
#include "tests/support/Allocations.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using namespace sciencemode;
using sciencemode::Command;
using std::chrono::microseconds;
using std::chrono::milliseconds;

/// Returns the commands in `written`, in order.
std::vector<Command> commandsOf(const std::vector<std::vector<std::uint8_t>>& written) {
    std::vector<Command> commands;
    for (const auto& bytes : written) {
        FrameDecoder decoder;
        std::span<const std::uint8_t> view(bytes);
        const auto before = commands.size();
        while (const auto packet = decoder.take(view)) commands.push_back(static_cast<Command>(packet->command));
        EXPECT_GT(commands.size(), before);
    }
    return commands;
}

std::vector<Command> lastTwo(const std::shared_ptr<EmulatedLine>& line) {
    auto all = commandsOf(line->written());
    return {all.end() - 2, all.end()};
}

const std::vector<Command> kStops{Command::LowLevelStop, Command::MidLevelStop};

TEST(ScienceModeStop, InMidTrainSilencesTheDevice) {
    RecordProperty("hazard", "H2");
    ScienceModeBench bench;
    ASSERT_TRUE(bench.stimulator->deliver(bench.approved(5, 500)).has_value());
    bench.wait(Seconds(0.5));
    const auto before = bench.line->pulses();
    ASSERT_GE(before, 50U);
    bench.stimulator->forceOff();
    EXPECT_EQ(lastTwo(bench.line), kStops) << "both stops are out before anything else";
    EXPECT_FALSE(bench.status().delivering);
    bench.wait(Seconds(10));
    EXPECT_EQ(bench.line->pulses(), before);
}

TEST(ScienceModeStop, CutsThePulseThatIsBeingPutOut) {
    RecordProperty("hazard", "H2");
    ScienceModeBench bench;
    auto train = biphasic(5, 1, 20);
    train.phaseWidth = Micros(4000);
    auto approval = bench.approved(train);
    // The stop frame that another thread would send while deliver() waits for the pulse's ack.
    FrameBytes stop = stopFrames().lowLevel;
    ASSERT_TRUE(bench.stimulator->deliver(std::move(approval)).has_value());
    EXPECT_FALSE(bench.line->pulseList().front().cut);
    bench.line->inspect([&](auto& device, Instant now) {
        FrameBytes init, pulse;
        EXPECT_TRUE(encodeFrame({0, 1, payloadOf(LowLevelInit{}).view()}, init));
        const auto plan = planPulse(train);
        EXPECT_TRUE(encodeFrame({2, 2, payloadOf(ChannelConfig{0, 0, true, plan->points})->view()}, pulse));
        device.receive(init.view(), now);
        device.receive(pulse.view(), now);
        device.receive(stop.view(), now + milliseconds(1));
    });
    EXPECT_TRUE(bench.line->pulseList().back().cut);
}

TEST(ScienceModeStop, IsRepeatedAfterAWriteThatWasInFlight) {
    RecordProperty("hazard", "H2");
    int writes = 0;  // declared before the bench, which writes until it is destroyed
    ScienceModeBench bench;
    bench.line->onWrite([&] {
        // The stop overtakes the pulse that is being written.
        if (++writes == 1) bench.stimulator->forceOff();
    });
    EXPECT_TRUE(bench.stimulator->deliver(bench.approved(5, 10)).has_value()) << "a stop is not an error";
    const auto commands = commandsOf(bench.line->written());
    const auto pulse = std::ranges::find(commands, Command::ChannelConfig);
    ASSERT_NE(pulse, commands.end());
    EXPECT_EQ(std::vector<Command>(pulse + 1, commands.end()), kStops);
    bench.wait(Seconds(1));
    EXPECT_LE(bench.line->pulses(), 1U);
    EXPECT_FALSE(bench.status().delivering);
}

TEST(ScienceModeStop, DuringInitialisationPreventsTheFirstPulse) {
    RecordProperty("hazard", "H2");
    ScienceModeBench bench;
    bench.stimulator->forceOff();  // deliver() must then initialise again
    bench.line->onWrite([&, writes = 0]() mutable {
        if (++writes == 1) bench.stimulator->forceOff();
    });
    EXPECT_TRUE(bench.stimulator->deliver(bench.approved(5, 10)).has_value());
    bench.wait(Seconds(1));
    EXPECT_EQ(bench.line->pulses(), 0U);
    EXPECT_EQ(bench.status().trainsDelivered, 0U);
}

TEST(ScienceModeStop, EndsALongTrainWithin2100MillisecondsOfAControlLoopThatHangs) {
    RecordProperty("hazard", "H2");
    ScienceModeBench bench;
    SafetyGate gate(bench.clock);
    Heartbeat heartbeat;
    StimulatorSession session(*bench.stimulator, gate, heartbeat, bench.clock, {});
    ASSERT_TRUE(bench.stimulator->deliver(bench.approved(5, 1000, 50)).has_value());  // a train of 20 s
    const auto runFor = [&](Seconds duration, bool loopAlive) {
        const Instant until = bench.clock.now() + toInstant(duration);
        while (bench.clock.now() < until) {
            if (loopAlive) heartbeat.beat(bench.clock.now());
            static_cast<void>(session.serve(bench.clock.now()));
            bench.wait(Seconds(0.01));
        }
    };
    runFor(Seconds(10), true);
    EXPECT_TRUE(bench.status().delivering) << "the control run goes on";
    EXPECT_GE(bench.line->pulses(), 500U);
    const Instant hung = bench.clock.now();
    runFor(Seconds(5), false);
    EXPECT_FALSE(bench.status().delivering);
    EXPECT_LE(bench.line->pulseList().back().end - hung, milliseconds(2100));
}

TEST(ScienceModeStop, KeepAliveAsksTheDeviceNothing) {
    ScienceModeBench bench;
    ASSERT_TRUE(bench.deliver(biphasic(5)).has_value());
    const auto before = bench.line->written().size();
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(bench.stimulator->keepAlive().has_value());
    EXPECT_EQ(bench.line->written().size(), before);
}

TEST(ScienceModeStop, NeverAllocates) {
    RecordProperty("hazard", "H2");
    if (!countsAllocations()) GTEST_SKIP() << kNotCounted;
    ScienceModeBench bench;
    ASSERT_TRUE(bench.stimulator->deliver(bench.approved(5, 50)).has_value());
    const auto before = allocationsOfThisThread();
    bench.stimulator->forceOff();
    bench.stimulator->forceOff();
    EXPECT_EQ(allocationsOfThisThread(), before);
}

TEST(ScienceModeStop, AnAcceptedPulseCostsNoAllocation) {
    if (!countsAllocations()) GTEST_SKIP() << kNotCounted;
    // Checks everything between approval and wire; only the emulated device behind the hook allocates.
    ScienceModeBench bench;
    ASSERT_TRUE(bench.deliver(biphasic(5)).has_value());
    auto approval = bench.approved(5);
    std::size_t begin = 0, atWire = 0;
    bench.line->onWrite([&] { atWire = allocationsOfThisThread(); });
    begin = allocationsOfThisThread();
    ASSERT_TRUE(bench.stimulator->deliver(std::move(approval)).has_value());
    EXPECT_EQ(atWire, begin);
}

TEST(ScienceModeStop, ClosingSendsTheStopsAndWaitsForThem) {
    RecordProperty("hazard", "H2");
    ScienceModeBench bench;
    ASSERT_TRUE(bench.stimulator->deliver(bench.approved(5, 50)).has_value());
    bench.wait(Seconds(0.1));
    bench.stimulator.reset();
    const auto before = bench.line->pulses();
    EXPECT_EQ(lastTwo(bench.line), kStops);
    EXPECT_EQ(bench.line->inspect([](auto& device, Instant now) { return device.state(now); }), Stimulation::None);
    bench.wait(Seconds(5));
    EXPECT_EQ(bench.line->pulses(), before);
}

// --- on the steady clock, with the driver's own thread ---------------------------------------------------------------

class ScienceModeThreads : public testing::Test {
protected:
    void SetUp() override {
        auto opened = ScienceModeStimulator::open(line_->connector(), "sciencemode:", {}, {}, clock_);
        ASSERT_IN_TIME(opened);
        stimulator_ = std::move(*opened);
        gate_ = benchGate(clock_, stimulator_->traits());
    }
    ApprovedTrain approved(int pulses, double rate_hz) {
        return approve(*gate_, clock_, biphasic(5, pulses, rate_hz), Seconds(2));
    }
    /// Asks until the train is over; the test's own time limit bounds the wait.
    Result<StimulatorStatus> untilDone() {
        for (;;) {
            auto status = stimulator_->status();
            if (!status || !status->delivering) return status;
            std::this_thread::sleep_for(milliseconds(1));
        }
    }

    SteadyClock clock_;
    std::shared_ptr<EmulatedLine> line_ = std::make_shared<EmulatedLine>(clock_, nullptr);
    std::unique_ptr<ScienceModeStimulator> stimulator_;
    std::unique_ptr<SafetyGate> gate_;
};

TEST_F(ScienceModeThreads, TheDriversOwnThreadSendsTheRestOfATrain) {
    // On a busy computer a train may be late and be given up: another train is then tried.
    for (int attempt = 0; attempt < 20; ++attempt) {
        const auto before = line_->pulses();
        auto outcome = stimulator_->deliver(approved(20, 200));
        if (outcome) {
            if (const auto status = untilDone(); !status) outcome = failure(status);
        }
        const auto pulses = line_->pulseList();
        for (std::size_t i = before + 1; i < pulses.size(); ++i) {
            ASSERT_GE(pulses[i].onset - pulses[i - 1].onset, microseconds(4400)) << "never faster than the rate";
        }
        if (outcome) {
            EXPECT_EQ(pulses.size() - before, 20U);
            return;
        }
        ASSERT_TRUE(cameLate(outcome.error())) << outcome.error().message;
    }
    ASSERT_IN_TIME(false) << "one of 20 trains";
}

TEST_F(ScienceModeThreads, ForceOffFromManyThreadsWhileDelivering) {
    RecordProperty("hazard", "H2");
    std::atomic<bool> done{false};
    std::vector<std::thread> stoppers;
    for (int i = 0; i < 4; ++i) {
        stoppers.emplace_back([&] {
            while (!done.load()) {
                stimulator_->forceOff();
                std::this_thread::sleep_for(microseconds(300));
            }
        });
    }
    int delivered = 0;
    for (int i = 0; i < 200; ++i) {
        if (stimulator_->deliver(approved(5, 1000))) ++delivered;
        static_cast<void>(stimulator_->status());
    }
    done = true;
    for (auto& stopper : stoppers) stopper.join();
    stimulator_->forceOff();
    RecordProperty("delivered", delivered);
    EXPECT_IN_TIME(delivered >= 1) << "each was refused: there was nothing to stop";
    const auto status = untilDone();
    EXPECT_TRUE(!status || !status->delivering);
    const auto after = line_->pulses();
    const Instant quietUntil = clock_.now() + milliseconds(50);
    while (clock_.now() < quietUntil) std::this_thread::sleep_for(milliseconds(5));
    EXPECT_EQ(line_->pulses(), after);
    // Afterwards the stimulator works as before.
    EXPECT_IN_TIME(stimulator_->deliver(approved(1, 100)));
    EXPECT_EQ(line_->pulses(), after + 1);
}

TEST_F(ScienceModeThreads, NoPulseFollowsAStopThatNothingWasInFlightAt) {
    RecordProperty("hazard", "H2");
    constexpr int kRounds = 30;
    int delivered = 0;
    for (int i = 0; i < kRounds; ++i) {
        if (stimulator_->deliver(approved(50, 500))) ++delivered;
        std::this_thread::sleep_for(microseconds(500 * i));
        stimulator_->forceOff();
    }
    RecordProperty("delivered", delivered);
    EXPECT_IN_TIME(delivered >= kRounds / 2) << "most were refused: there was nothing to stop";
    // Each pulse that was sent after a stop is followed by another stop.
    const auto commands = commandsOf(line_->written());
    EXPECT_NE(commands.back(), Command::ChannelConfig);
    const auto after = line_->pulses();
    const Instant quietUntil = clock_.now() + milliseconds(20);
    while (clock_.now() < quietUntil) std::this_thread::sleep_for(milliseconds(2));
    EXPECT_EQ(line_->pulses(), after);
}

TEST_F(ScienceModeThreads, FromApprovalToTheWireTakesLessThan200Microseconds) {
#ifdef TACTOSCOPE_SANITIZED
    GTEST_SKIP() << "the sanitizers take their own time";
#else
    ASSERT_IN_TIME(stimulator_->deliver(approved(1, 100)));
    Instant atWire{0};
    line_->onWrite([&] { atWire = clock_.now(); });
    std::vector<Instant> took;
    for (int i = 0; i < 201; ++i) {
        auto approval = approved(1, 100);
        const Instant begin = clock_.now();
        ASSERT_IN_TIME(stimulator_->deliver(std::move(approval)));
        took.push_back(atWire - begin);
        ASSERT_IN_TIME(untilDone());
    }
    line_->onWrite([] {});  // the device is still written to when it is closed
    std::ranges::nth_element(took, took.begin() + 100);
    RecordProperty("median_ns", std::to_string(took[100].count()));
    EXPECT_IN_TIME(took[100] < microseconds(200));
#endif
}

}  // namespace
}  // namespace tacto::test
