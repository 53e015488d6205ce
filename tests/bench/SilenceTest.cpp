// After a process was stopped or the computer slept, the loop and a device's thread wake in either order; nothing is
// delivered until the operator arms again (H2).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/bench/Bench.h"
#include "tests/bench/FakeMassager.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using namespace std::chrono_literals;
using test::refused;

enum class Order { LoopFirst, DeviceFirst };

/// A control loop and one output; the test schedules both.
class Silence : public testing::TestWithParam<std::tuple<Order, bool>> {
protected:
    Silence() {
        RecordProperty("hazard", "H2");
        stimulator.traits_.readsBack = !std::get<1>(GetParam());  // a massager's arming is confirmed, not measured
        ControlLoop::Parts parts{clock, gate, interlock, heartbeat, OutputMode::BenchLoad, nullptr, nullptr, 0, {}};
        parts.stops = &stops;
        if (std::get<1>(GetParam()))
            parts.massager = &massagerSession;
        else
            parts.stimulator = &stimulatorSession;
        loop = std::make_unique<ControlLoop>(
            std::move(parts), nullptr, std::make_unique<TrainPlanner>(EncodingProfile{}, stimulator.traits(), gate));
    }
    void serve() {
        if (std::get<1>(GetParam()))
            massagerSession.serve(clock.now());
        else
            stimulatorSession.serve(clock.now());
    }
    /// One turn of the loop and the device, in the order of the test.
    void turn() {
        if (std::get<0>(GetParam()) == Order::DeviceFirst) serve();
        loop->step(clock.now());
        if (std::get<0>(GetParam()) == Order::LoopFirst) serve();
    }
    void pass(Instant duration) {
        const Instant until = clock.now() + duration;
        while (clock.now() < until) {
            clock.advanceTo(clock.now() + ControlLoop::kPeriod);
            turn();
        }
    }
    [[nodiscard]] std::size_t delivered() const {
        return std::get<1>(GetParam()) ? massager.sent().size() : static_cast<std::size_t>(stimulator.delivered);
    }
    [[nodiscard]] int offs() const { return std::get<1>(GetParam()) ? massager.offs : stimulator.offs; }
    void arm() {
        test::armFake(*loop, interlock, stimulator, clock, stops.mark());
        loop->drive({DriveSource::Manual, 1, 1});
        turn();
        turn();
    }
    /// Delivers until the next train is handed over but not yet written.
    void deliverUntilOneIsHandedOver() {
        arm();
        pass(1200ms);
        ASSERT_GE(delivered(), 2U);
        const auto before = delivered();
        const Instant giveUp = clock.now() + 1s;
        // The device's thread does not run, so the train handed over stays unwritten.
        const auto idle = [this] {
            return std::get<1>(GetParam()) ? massagerSession.idle() : stimulatorSession.idle();
        };
        while (idle() && clock.now() < giveUp) {
            clock.advanceTo(clock.now() + ControlLoop::kPeriod);
            serve();
            loop->step(clock.now());
        }
        ASSERT_FALSE(idle());
        ASSERT_EQ(delivered(), before);
    }

    VirtualClock clock;
    SafetyGate gate{clock};
    Interlock interlock;
    Heartbeat heartbeat;
    StopCounter stops;
    test::FakeStimulator stimulator{clock};
    test::FakeMassager massager{clock};
    StimulatorSession stimulatorSession{stimulator, gate, heartbeat, clock, {}};
    MassagerSession massagerSession{massager, gate, heartbeat, clock, {}};
    std::unique_ptr<ControlLoop> loop;
};

TEST_P(Silence, OfTheWholeProcessEndsOutputBeforeTheNextTrain) {
    for (const Instant silence : {Instant(101ms), Instant(5s)}) {
        deliverUntilOneIsHandedOver();
        const auto before = delivered();
        const auto off = offs();
        clock.advanceTo(clock.now() + silence);  // SIGSTOP, SIGCONT
        pass(3s);
        EXPECT_EQ(delivered(), before);
        EXPECT_GT(offs(), off);
        EXPECT_EQ(interlock.state(), InterlockState::Faulted);
        EXPECT_TRUE(interlock.causePersists(FaultCause::LoopSilent));
        interlock.causeGone(FaultCause::LoopSilent);
        ASSERT_TRUE(interlock.reset());
        pass(3s);
        EXPECT_EQ(delivered(), before) << "a reset arms nothing";
    }
    arm();
    pass(1s);
    EXPECT_EQ(interlock.state(), InterlockState::Delivering) << "and arming does";
}

TEST_P(Silence, BetweenAnApprovalAndTheFirstTrainEndsOutputToo) {
    arm();
    const auto before = delivered();
    clock.advanceTo(clock.now() + 200ms);
    pass(3s);
    EXPECT_LE(delivered(), before);
    EXPECT_EQ(interlock.state(), InterlockState::Faulted);
}

TEST_P(Silence, WhilePausedIsNotResumedFrom) {
    arm();
    pass(600ms);
    ASSERT_TRUE(interlock.pause());
    loop->pauseOutput(true);
    const auto before = delivered();
    clock.advanceTo(clock.now() + 5s);
    pass(100ms);
    EXPECT_FALSE(interlock.resume());
    loop->pauseOutput(false);
    pass(3s);
    EXPECT_EQ(delivered(), before);
}

TEST_P(Silence, OfUpToAHundredMillisecondsGoesOn) {
    arm();
    pass(600ms);
    const auto before = delivered();
    clock.advanceTo(clock.now() + 95ms);
    pass(1200ms);
    EXPECT_GT(delivered(), before);
    EXPECT_EQ(interlock.state(), InterlockState::Delivering);
}

TEST_P(Silence, WhileDisarmedIsNoFault) {
    ASSERT_TRUE(interlock.connect());
    pass(100ms);
    clock.advanceTo(clock.now() + 5s);
    pass(100ms);
    EXPECT_EQ(interlock.state(), InterlockState::Disarmed);
    arm();
    pass(1s);
    EXPECT_GE(delivered(), 1U);
}

TEST_P(Silence, OfAComputerThatSleptDisarmsSaysWhyAndEndsTheOrder) {
    deliverUntilOneIsHandedOver();
    const auto before = delivered();
    const auto off = offs();
    const auto asked = stops.mark();
    clock.sleepFor(12s);  // CLOCK_MONOTONIC stands still: nothing has expired
    pass(3s);
    EXPECT_EQ(delivered(), before);
    EXPECT_GT(offs(), off);
    EXPECT_EQ(interlock.state(), InterlockState::Disarmed);
    EXPECT_EQ(interlock.reason().view(), "the computer slept for 12 s");
    EXPECT_EQ(loop->endedBecause().view(), "the computer slept for 12 s");
    EXPECT_TRUE(stops.movedSince(asked)) << "what was asked for before it slept is over";
    arm();
    pass(1s);
    EXPECT_EQ(interlock.state(), InterlockState::Delivering);
}

TEST_P(Silence, OfWhatOrderedTheOutputEndsItWhileTheLoopRunsOn) {
    deliverUntilOneIsHandedOver();
    const auto asked = stops.mark();
    loop->attend(clock.now() + 2s);
    pass(1900ms);
    EXPECT_EQ(interlock.state(), InterlockState::Delivering);
    loop->attend(clock.now() + 2s);
    pass(1900ms);
    EXPECT_EQ(interlock.state(), InterlockState::Delivering) << "it was looked after";
    pass(200ms);
    EXPECT_EQ(interlock.state(), InterlockState::Disarmed);
    EXPECT_THAT(std::string(interlock.reason().view()), testing::HasSubstr("did not look after it"));
    EXPECT_TRUE(stops.movedSince(asked));
    const auto before = delivered();
    pass(3s);
    EXPECT_EQ(delivered(), before);
    loop->beginOrder();
    EXPECT_TRUE(loop->endedBecause().empty());
}

TEST_P(Silence, OfAShortSleepIsASilence) {
    deliverUntilOneIsHandedOver();
    const auto before = delivered();
    clock.sleepFor(500ms);
    pass(3s);
    EXPECT_EQ(delivered(), before);
    EXPECT_EQ(interlock.state(), InterlockState::Faulted);
}

TEST_P(Silence, DuringTheWriteSwitchesOffBehindIt) {
    arm();
    pass(600ms);
    int offsAtWrite = -1;
    const auto standStill = [&] {
        if (offsAtWrite < 0) clock.advanceTo(clock.now() + 5s);
        offsAtWrite = offs();
    };
    stimulator.onDeliver = standStill;
    massager.onVibrate = standStill;
    pass(600ms);
    ASSERT_GE(offsAtWrite, 0);
    EXPECT_GT(offs(), offsAtWrite);
    const auto before = delivered();
    pass(3s);
    EXPECT_EQ(delivered(), before);
    EXPECT_EQ(interlock.state(), InterlockState::Faulted);
}

INSTANTIATE_TEST_SUITE_P(EitherOrder, Silence,
                         testing::Combine(testing::Values(Order::LoopFirst, Order::DeviceFirst), testing::Bool()));

TEST(LateTrain, ADeviceThatIsProgrammedSlowlyIsNotMissingItsStatus) {
    testing::Test::RecordProperty("hazard", "H3");
    const auto clock = std::make_shared<VirtualClock>();
    BenchConfig config;
    auto made = std::make_unique<test::FakeStimulator>(*clock);
    auto& device = *made;
    config.devices.stimulator = std::move(made);
    config.clock = clock;
    config.limits = {test::generousLimits()};
    const auto bench = Bench::create(std::move(config)).value();
    device.onDeliver = [&] { clock->advanceTo(clock->now() + 60ms); };
    ASSERT_TRUE(bench->arm(ArmRequest{"1 kohm", true, true}));
    ASSERT_TRUE(bench->drive(DriveSource::Manual, 1, 1));
    const auto waited = bench->wait(Seconds(5));
    EXPECT_TRUE(waited) << waited.error().message;
    EXPECT_GE(device.delivered, 8);
}

TEST(LateTrain, ADeviceThreadThatNeverBeginsItIsAFault) {
    testing::Test::RecordProperty("hazard", "H3");
    VirtualClock clock;
    SafetyGate gate(clock);
    Interlock interlock;
    Heartbeat heartbeat;
    test::FakeStimulator device(clock);
    StimulatorSession session(device, gate, heartbeat, clock, {});
    ControlLoop loop({clock, gate, interlock, heartbeat, OutputMode::BenchLoad, &session, nullptr, 0, {}}, nullptr,
                     std::make_unique<TrainPlanner>(EncodingProfile{}, device.traits(), gate));
    const auto step = [&] {
        clock.advanceTo(clock.now() + ControlLoop::kPeriod);
        loop.step(clock.now());
    };
    test::armFake(loop, interlock, device, clock);
    for (int i = 0; i < 4; ++i) {
        step();
        session.serve(clock.now());
    }
    loop.drive({DriveSource::Manual, 1, 1});
    while (session.idle()) step();
    const Instant posted = clock.now();
    // For the loop, the thread seems to hang in deliver().
    while (clock.now() < posted + 200ms) step();
    EXPECT_EQ(interlock.state(), InterlockState::Delivering) << "it may still be programming the device";
    while (clock.now() < posted + 260ms) step();
    EXPECT_EQ(interlock.state(), InterlockState::Faulted);
    EXPECT_TRUE(interlock.causePersists(FaultCause::StatusMissing));
}

TEST(SleepingComputer, EndsARunWithItsReason) {
    testing::Test::RecordProperty("hazard", "H2");
    const auto clock = std::make_shared<VirtualClock>();
    BenchConfig config;
    config.devices.stimulator = std::make_unique<test::FakeStimulator>(*clock);
    config.clock = clock;
    config.limits = {test::generousLimits()};
    const auto bench = Bench::create(std::move(config)).value();
    ASSERT_TRUE(bench->arm(ArmRequest{"1 kohm", true, true}));
    ASSERT_TRUE(bench->drive(DriveSource::Manual, 1, 1));
    ASSERT_TRUE(bench->wait(Seconds(1)));
    clock->sleepFor(3600s);
    EXPECT_THAT(bench->wait(Seconds(1)),
                refused(ErrorCode::Stopped, testing::Eq("stopped: the computer slept for 3600 s. Output is off.")));
    EXPECT_FALSE(bench->arm(ArmRequest{"1 kohm", true, true})) << "a script cannot arm again by itself";
    ASSERT_TRUE(bench->begin(bench->stops().mark()));
    EXPECT_TRUE(bench->arm(ArmRequest{"1 kohm", true, true}));
    bench->stop("test");
    EXPECT_EQ(bench->wait(Seconds(1)).error().message, "stopped. Output is off.");
}

}  // namespace
}  // namespace tacto
