// Stops at the worst moments: during a write, during the check, between voiding and disarming. The fake stimulator
// records what reached it and when.
#include <gtest/gtest.h>
#include <thread>

#include "core/bench/Bench.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using namespace std::chrono_literals;
using test::refused;

class StopTest : public testing::Test {
protected:
    void open(bool realTime, std::shared_ptr<StopCounter> stops = nullptr, StopMark asked = {}) {
        bench_.reset();
        if (realTime)
            clock_ = std::make_shared<SteadyClock>();
        else
            clock_ = std::make_shared<VirtualClock>();
        BenchConfig config;
        auto device = std::make_unique<test::FakeStimulator>(*clock_);
        device_ = device.get();
        config.devices.stimulator = std::move(device);
        config.clock = clock_;
        config.limits = {test::generousLimits()};
        config.stops = std::move(stops);
        config.asked = asked;
        config.watched = watched_;
        bench_ = Bench::create(std::move(config)).value();
    }
    [[nodiscard]] Result<void> arm() { return bench_->arm(ArmRequest{"1 kohm", true, true}); }

    std::shared_ptr<Clock> clock_;
    std::unique_ptr<Bench> bench_;
    test::FakeStimulator* device_ = nullptr;
    std::function<bool()> watched_;
};

TEST_F(StopTest, ReachesForceOffBeforeItReturns) {
    RecordProperty("hazard", "H2");
    open(false);
    ASSERT_TRUE(arm());
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_TRUE(bench_->wait(Seconds(1)));
    const int before = device_->offs;
    bench_->stop("test");
    EXPECT_GT(device_->offs, before);
}

TEST_F(StopTest, DuringAWriteSwitchesOffAfterTheWrite) {
    RecordProperty("hazard", "H2");
    open(false);
    ASSERT_TRUE(arm());
    device_->onDeliver = [this] { bench_->stop("test"); };
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
    EXPECT_FALSE(bench_->wait(Seconds(2)));
    EXPECT_FALSE(device_->on);
    device_->onDeliver = nullptr;
    const int delivered = device_->delivered;
    ASSERT_TRUE(bench_->begin(bench_->stops().mark()));
    ASSERT_TRUE(bench_->wait(Seconds(3)));
    EXPECT_EQ(device_->delivered, delivered);
}

TEST_F(StopTest, OfATrainThatThenReadsTooLittleIsNoFaultAndOfOneThatReadsTooMuchIs) {
    RecordProperty("hazard", "H2");
    const auto after = [this](double measured, bool stopped) {
        open(false);
        EXPECT_TRUE(arm());
        device_->onDeliver = [this, measured, stopped] {
            device_->measured = measured;
            if (stopped) bench_->stop("test");
        };
        EXPECT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
        EXPECT_FALSE(bench_->wait(Seconds(2)));
        if (stopped) {
            EXPECT_TRUE(bench_->begin(bench_->stops().mark()));
            static_cast<void>(bench_->wait(Seconds(1)));  // reads the train that was cut off
        }
        const auto seen = bench_->telemetry().state;
        device_->onDeliver = nullptr;
        return seen;
    };
    EXPECT_EQ(after(1, false), InterlockState::Faulted) << "40 V were commanded";
    EXPECT_EQ(after(1, true), InterlockState::Disarmed) << "the pulse before it, in a train that was cut off";
    EXPECT_EQ(after(60, true), InterlockState::Faulted);
}

TEST_F(StopTest, APauseIsNoneAndATrainThatReadsTooLittleIsAFault) {
    RecordProperty("hazard", "H2");
    open(true);
    ASSERT_IN_TIME(arm());
    device_->onDeliver = [this] {
        device_->measured = 1;
        bench_->pause();
    };
    ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 1, 1));
    const auto giveUp = clock_->now() + 2s;
    while (bench_->telemetry().state != InterlockState::Faulted && clock_->now() < giveUp)
        std::this_thread::sleep_for(1ms);
    EXPECT_IN_TIME(bench_->telemetry().state == InterlockState::Faulted) << nameOf(bench_->telemetry().state);
}

TEST_F(StopTest, WhileTheDriveIsSetLeavesNoDriveForTheNextArming) {
    RecordProperty("hazard", "H2");
    std::atomic<bool> stops{false};
    watched_ = [&] {  // called before the loop is told
        if (stops.exchange(false)) {
            bench_->stop("test");
            std::this_thread::sleep_for(20ms);  // a few turns of the loop
        }
        return true;
    };
    open(true);
    ASSERT_IN_TIME(arm());
    stops = true;
    const auto driven = bench_->drive(DriveSource::Manual, 1, 1);
    ASSERT_FALSE(driven);
    EXPECT_CODE_IN_TIME(driven.error().code, ErrorCode::Stopped);
    ASSERT_IN_TIME(bench_->begin(bench_->stops().mark()));
    ASSERT_IN_TIME(arm());
    const int delivered = device_->delivered;
    ASSERT_IN_TIME(bench_->wait(Seconds(1)));
    EXPECT_EQ(device_->delivered, delivered);
}

TEST_F(StopTest, AFaultIsKeptWhenTheOutputIsOffAndNotBefore) {
    RecordProperty("hazard", "H2");
    open(false);
    ASSERT_TRUE(arm());
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_TRUE(bench_->wait(Seconds(1)));
    std::optional<InterlockState> atFirst;
    device_->onOff = [&] {
        if (!atFirst) atFirst = bench_->telemetry().state;
    };
    device_->electrode = ElectrodeState::Open;
    EXPECT_FALSE(bench_->wait(Seconds(2)));
    EXPECT_EQ(atFirst, InterlockState::Delivering) << "a slow disk, on which the fault is kept, would hold it up";
    EXPECT_EQ(bench_->telemetry().state, InterlockState::Faulted);
    device_->onOff = nullptr;
}

TEST_F(StopTest, DuringTheCheckEndsArmingAndDeliversNothingMore) {
    RecordProperty("hazard", "H2");
    open(false);
    device_->onDeliver = [this] { bench_->stop("test"); };
    const auto armed = arm();
    ASSERT_FALSE(armed);
    device_->onDeliver = nullptr;
    const int delivered = device_->delivered;
    EXPECT_FALSE(arm()) << "a stopped bench does not arm";
    EXPECT_EQ(device_->delivered, delivered) << "not even a check pulse";
    ASSERT_TRUE(bench_->begin(bench_->stops().mark()));
    ASSERT_TRUE(bench_->wait(Seconds(1)));
    EXPECT_EQ(device_->delivered, delivered) << "and no check left over from before";
    EXPECT_TRUE(arm());
}

TEST_F(StopTest, IsNeverForgottenByAnOrderFromBeforeIt) {
    RecordProperty("hazard", "H2");
    open(false);
    const auto asked = bench_->stops().mark();
    bench_->stop("test");
    EXPECT_THAT(bench_->begin(asked), refused(ErrorCode::Stopped));
    EXPECT_FALSE(bench_->begin(StopMark())) << "nor by one whose mark was forgotten";
    EXPECT_FALSE(bench_->begin(StopCounter().mark())) << "nor by one of another counter";
    EXPECT_FALSE(arm());
    EXPECT_FALSE(bench_->drive(DriveSource::Manual, 1, 1));
    EXPECT_TRUE(bench_->drive(DriveSource::Off)) << "less output is never refused";
    bench_->idle(Seconds(3));
    EXPECT_EQ(device_->delivered, 0);
    ASSERT_TRUE(bench_->begin(bench_->stops().mark()));
    EXPECT_TRUE(arm());
}

TEST_F(StopTest, ABenchThatWasAskedForBeforeAStopDoesNothing) {
    RecordProperty("hazard", "H2");
    const auto stops = std::make_shared<StopCounter>();
    const auto asked = stops->mark();
    stops->raise();
    open(false, stops, asked);
    EXPECT_FALSE(arm());
    bench_->idle(Seconds(1));
    EXPECT_EQ(device_->delivered, 0);
}

TEST_F(StopTest, JustBeforeCheckingIsEnteredIsFollowedByNoCheckPulse) {
    RecordProperty("hazard", "H2");
    // The stop finds the interlock disarmed, so it has nothing to disarm, and it voids approvals before any exist.
    const VirtualClock clock;
    SafetyGate gate(clock);
    Interlock interlock;
    Heartbeat heartbeat;
    test::FakeStimulator device(clock);
    StimulatorSession session(device, gate, heartbeat, clock, {});
    StopCounter stops;
    ControlLoop::Parts parts{clock, gate, interlock, heartbeat, OutputMode::BenchLoad, &session, nullptr, 0, {}};
    parts.stops = &stops;
    for (const bool readsBack : {true, false}) {
        device.traits_.readsBack = readsBack;
        ControlLoop loop(parts, nullptr, std::make_unique<TrainPlanner>(EncodingProfile{}, device.traits(), gate));
        const auto asked = stops.mark();
        stops.raise();
        interlock.disarm("stopped");
        gate.latchStop();
        test::armFake(loop, interlock, device, clock, asked);
        loop.drive({DriveSource::Manual, 1, 1});
        for (int i = 0; i < 3; ++i) {
            loop.step(clock.now());
            session.serve(clock.now());
        }
        EXPECT_EQ(device.delivered, 0);
        EXPECT_EQ(interlock.state(), InterlockState::Disarmed);
        const auto armed = loop.armed();
        ASSERT_TRUE(armed);
        ASSERT_FALSE(*armed);
        EXPECT_EQ(armed->error().code, ErrorCode::Stopped);
    }
}

TEST_F(StopTest, AtAnyMomentOfArmingAndDrivingIsFollowedByNoTrain) {
    RecordProperty("hazard", "H2");
    constexpr int kRounds = 40;
    int armed = 0, driven = 0;
    for (int round = 0; round < kRounds; ++round) {
        open(true);
        std::atomic<bool> stopped{false};
        std::atomic<int> afterStop{0};
        device_->onDeliver = [&] {
            if (stopped) ++afterStop;
        };
        std::thread stopper([&, round] {
            std::this_thread::sleep_for(std::chrono::microseconds(400 * round));
            bench_->stop("test");
            stopped = true;
        });
        if (arm()) {
            ++armed;
            if (bench_->drive(DriveSource::Manual, 1, 1)) {
                ++driven;
                EXPECT_IN_TIME(!bench_->wait(Seconds(1))) << "the stop ends it";
            }
        }
        stopper.join();
        std::this_thread::sleep_for(15ms);  // three turns of the loop
        EXPECT_EQ(afterStop, 0) << "round " << round;
        bench_.reset();
    }
    RecordProperty("armed", armed);
    RecordProperty("driven", driven);
    EXPECT_IN_TIME(driven >= kRounds / 10) << "most stops came before there was anything to stop";
    EXPECT_IN_TIME(driven < kRounds) << "no stop came while it was arming";
}

TEST_F(StopTest, AStatusThatNeverComesIsAFault) {
    RecordProperty("hazard", "H3");
    open(true);
    ASSERT_IN_TIME(arm());
    device_->statusBlocks = true;
    ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 1, 1));
    const auto waited = bench_->wait(Seconds(5));
    device_->statusBlocks = false;
    ASSERT_FALSE(waited);
    EXPECT_EQ(bench_->telemetry().state, InterlockState::Faulted);
    EXPECT_IN_TIME(clock_->now() < 3s) << "found by the loop, not by the device thread that waits";
}

TEST_F(StopTest, APauseHoldsBackTheTrainAlreadyHandedOver) {
    RecordProperty("hazard", "H2");
    open(false);
    ASSERT_TRUE(arm());
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_TRUE(bench_->wait(Seconds(1)));
    bench_->pause();
    bench_->resume();
    EXPECT_TRUE(bench_->wait(Seconds(1))) << "and it goes on afterwards";
    EXPECT_EQ(bench_->telemetry().state, InterlockState::Delivering);
}

}  // namespace
}  // namespace tacto
