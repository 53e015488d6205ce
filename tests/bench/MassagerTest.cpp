// A massager instead of electrodes: the same encoder, the same stop.
#include <gtest/gtest.h>
#include <thread>

#include "core/session/SessionReader.h"
#include "tests/bench/BenchFixture.h"
#include "tests/bench/FakeMassager.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using test::FakeMassager;
using test::refusedSaying;

class MassagerTest : public testing::Test {
protected:
    void open(bool realTime = false) {
        if (realTime)
            clock_ = std::make_shared<SteadyClock>();
        else
            clock_ = std::make_shared<VirtualClock>();
        BenchConfig config;
        auto device = std::make_unique<FakeMassager>(*clock_);
        device_ = device.get();
        config.devices.massager = std::move(device);
        config.clock = clock_;
        config.limits = {test::generousLimits()};
        bench_ = Bench::create(std::move(config)).value();
    }
    [[nodiscard]] Result<void> arm() { return bench_->arm(ArmRequest{"1 kohm", true, true}); }

    std::shared_ptr<Clock> clock_;
    std::unique_ptr<Bench> bench_;
    FakeMassager* device_ = nullptr;
};

TEST_F(MassagerTest, FeelsWhatTheElectrodesWouldSay) {
    open();
    ASSERT_TRUE(arm());
    EXPECT_TRUE(device_->sent().empty()) << "arming sends nothing: there is no load to check";
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 0.5, 1));
    ASSERT_TRUE(bench_->wait(Seconds(10.2)));
    const auto sent = device_->sent();
    ASSERT_EQ(sent.size(), 21U) << "every 0.5 s from 0 to 10 s";
    for (std::size_t i = 0; i < sent.size(); ++i) {
        EXPECT_DOUBLE_EQ(sent[i].burst.intensity, 25.0 / 40) << "A / A_max";
        EXPECT_NEAR(toSeconds(sent[i].at - sent[0].at), 0.5 * static_cast<double>(i), 0.006);
    }
    const auto seen = bench_->telemetry();
    EXPECT_EQ(seen.state, InterlockState::Delivering);
    EXPECT_DOUBLE_EQ(seen.intensity, 25.0 / 40);
    EXPECT_EQ(seen.trainsDelivered, 21U);
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 0, 0));
    ASSERT_TRUE(bench_->wait(Seconds(4.2)));
    EXPECT_DOUBLE_EQ(device_->sent().back().burst.intensity, 0.25) << "the smooth one is felt too";
}

TEST_F(MassagerTest, SendsNothingBeforeItIsArmedAndNothingAfterAStop) {
    RecordProperty("hazard", "H2");
    open();
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_TRUE(bench_->wait(Seconds(2)));
    EXPECT_TRUE(device_->sent().empty());
    ASSERT_TRUE(arm());
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_TRUE(bench_->wait(Seconds(2)));
    const int before = device_->offs;
    const auto sent = device_->sent().size();
    EXPECT_GT(sent, 0U);
    bench_->stop("test");
    EXPECT_GT(device_->offs, before) << "the stop report went out before stop() returned";
    ASSERT_TRUE(bench_->begin(bench_->stops().mark()));
    ASSERT_TRUE(bench_->wait(Seconds(5)));
    EXPECT_EQ(device_->sent().size(), sent);
}

TEST_F(MassagerTest, AStopDuringTheWriteIsRepeatedBehindIt) {
    RecordProperty("hazard", "H2");
    open();
    ASSERT_TRUE(arm());
    int offsInWrite = 0;
    device_->onVibrate = [&] {
        bench_->stop("test");
        offsInWrite = device_->offs;
    };
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
    EXPECT_FALSE(bench_->wait(Seconds(2)));
    EXPECT_GT(device_->offs, offsInWrite);
    EXPECT_EQ(device_->sent().size(), 1U);
}

TEST_F(MassagerTest, AnUnplugIsAFaultThatAResetLeaves) {
    RecordProperty("hazard", "H2");
    open();
    ASSERT_TRUE(arm());
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_TRUE(bench_->wait(Seconds(1)));
    device_->unplugged = true;
    EXPECT_THAT(bench_->wait(Seconds(2)), refusedSaying("unplugged"));
    EXPECT_EQ(bench_->telemetry().state, InterlockState::Faulted);
    const auto sent = device_->sent().size();
    device_->unplugged = false;
    ASSERT_TRUE(bench_->resetFault());
    EXPECT_EQ(bench_->telemetry().state, InterlockState::Disarmed) << "not armed by itself";
    ASSERT_TRUE(bench_->wait(Seconds(2)));
    EXPECT_EQ(device_->sent().size(), sent);
}

TEST_F(MassagerTest, APauseHoldsItBack) {
    open();
    ASSERT_TRUE(arm());
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_TRUE(bench_->wait(Seconds(1)));
    bench_->pause();
    bench_->idle(Seconds(0.001));
    const auto sent = device_->sent().size();
    bench_->idle(Seconds(3));
    EXPECT_EQ(device_->sent().size(), sent);
    bench_->resume();
    ASSERT_TRUE(bench_->wait(Seconds(1.2)));
    EXPECT_GT(device_->sent().size(), sent);
}

TEST_F(MassagerTest, OnItsOwnThreadToo) {
    RecordProperty("hazard", "H2");
    open(true);
    ASSERT_IN_TIME(arm());
    ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_IN_TIME(bench_->wait(Seconds(1.3)));
    EXPECT_IN_TIME(device_->sent().size() >= 2U);
    const int before = device_->offs;
    bench_->stop("test");
    EXPECT_GT(device_->offs, before);
    const auto sent = device_->sent().size();
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    EXPECT_EQ(device_->sent().size(), sent);
}

class MassagerWithFinger : public test::BenchFixture {};

TEST_F(MassagerWithFinger, IsSilentWhileNothingIsTouched) {
    RecordProperty("hazard", "H7");
    open({"sim:finger", "sim:massager"}, {Role::Sensor, Role::Massager});
    ASSERT_TRUE(bench_->devices().surface->present("", MillimetresPerSecond(0), Newtons(0)));
    ASSERT_TRUE(arm());
    ASSERT_TRUE(bench_->drive(DriveSource::Sensor));
    ASSERT_TRUE(bench_->wait(Seconds(3)));
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
    ASSERT_TRUE(bench_->devices().surface->present("P60", MillimetresPerSecond(50), Newtons(1)));
    ASSERT_TRUE(bench_->wait(Seconds(5)));
    const auto rough = bench_->telemetry();
    EXPECT_GT(rough.trainsDelivered, 1U);
    ASSERT_TRUE(bench_->devices().surface->present("glass", MillimetresPerSecond(50), Newtons(1)));
    ASSERT_TRUE(bench_->wait(Seconds(6)));
    EXPECT_GT(rough.intensity, bench_->telemetry().intensity + 0.2) << "rough is felt stronger than smooth";
}

TEST_F(MassagerWithFinger, AStimulatorComesFirst) {
    open({"sim:stimulator?load=1kohm", "sim:massager"}, {Role::Stimulator, Role::Massager});
    ASSERT_TRUE(arm());
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_TRUE(bench_->wait(Seconds(2)));
    EXPECT_GT(bench_->telemetry().trainsDelivered, 2U);
    EXPECT_TRUE(std::isnan(bench_->telemetry().intensity)) << "one output at a time";
}

}  // namespace
}  // namespace tacto
