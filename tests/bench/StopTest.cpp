// Stops at the worst moments: during a write, during the check, between voiding and disarming. The stimulator is a fake
// that tells what reached it and when.
#include <gtest/gtest.h>
#include <thread>

#include "core/bench/Bench.h"
#include "tests/bench/FakeStimulator.h"

namespace tacto {
namespace {

using namespace std::chrono_literals;

class StopTest : public testing::Test {
protected:
    void open(bool realTime) {
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
        bench_ = Bench::create(std::move(config)).value();
    }
    [[nodiscard]] Result<void> arm() { return bench_->arm(ArmRequest{"1 kohm", true, true}); }

    std::shared_ptr<Clock> clock_;
    std::unique_ptr<Bench> bench_;
    test::FakeStimulator* device_ = nullptr;
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
    bench_->clearStop();
    ASSERT_TRUE(bench_->wait(Seconds(3)));
    EXPECT_EQ(device_->delivered, delivered);
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
    bench_->clearStop();
    ASSERT_TRUE(bench_->wait(Seconds(1)));
    EXPECT_EQ(device_->delivered, delivered) << "and no check left over from before";
    EXPECT_TRUE(arm());
}

TEST_F(StopTest, AtAnyMomentOfArmingAndDrivingIsFollowedByNoTrain) {
    RecordProperty("hazard", "H2");
    for (int round = 0; round < 40; ++round) {
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
        if (arm() && bench_->drive(DriveSource::Manual, 1, 1)) static_cast<void>(bench_->wait(Seconds(0.03)));
        stopper.join();
        std::this_thread::sleep_for(15ms);  // three turns of the loop
        EXPECT_EQ(afterStop, 0) << "round " << round;
        bench_.reset();
    }
}

TEST_F(StopTest, AStatusThatNeverComesIsAFault) {
    RecordProperty("hazard", "H3");
    open(true);
    ASSERT_TRUE(arm());
    device_->statusBlocks = true;
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
    const auto waited = bench_->wait(Seconds(5));
    device_->statusBlocks = false;
    ASSERT_FALSE(waited);
    EXPECT_EQ(bench_->telemetry().state, InterlockState::Faulted);
    EXPECT_LT(clock_->now(), 3s) << "found by the loop, not by the device thread that waits";
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
