// The bench on the steady clock: threads, stop latency, and the control loop's timing.
#include <algorithm>
#include <thread>
#include <vector>

#include "tests/bench/BenchFixture.h"
#include "tests/support/InTime.h"

namespace tacto {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

class RealTimeBenchTest : public test::BenchFixture {};

TEST_F(RealTimeBenchTest, PausedDeliversNothingAndGoesOnAfterwards) {
    open({}, {Role::Stimulator}, true);
    ASSERT_IN_TIME(arm());
    ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 0, 1));
    ASSERT_IN_TIME(bench_->wait(Seconds(0.3)));
    bench_->pause();
    ASSERT_IN_TIME(bench_->wait(Seconds(0.1)));
    const auto delivered = bench_->telemetry().trainsDelivered;
    ASSERT_IN_TIME(bench_->wait(Seconds(1.2)));
    EXPECT_EQ(bench_->telemetry().trainsDelivered, delivered);
    EXPECT_IN_TIME(state() == InterlockState::Paused);
    bench_->resume();
    ASSERT_IN_TIME(bench_->wait(Seconds(0.8)));
    EXPECT_IN_TIME(bench_->telemetry().trainsDelivered > delivered);
}

TEST_F(RealTimeBenchTest, DeliversOnTimeWithAThreadPerDevice) {
    open({"sim:finger?material=P60&force=6N"}, {Role::Sensor, Role::Stimulator, Role::Oscilloscope}, true);
    ASSERT_IN_TIME(arm());
    ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 1, 1));
    const auto captures = bench_->capture(4, ScopeSettings{});
    ASSERT_IN_TIME(captures);
    for (std::size_t i = 1; i < captures->size(); ++i) {
        // A busy machine may be a few milliseconds late; a missed turn would be late by a whole interval.
        const double apart_s = (*captures)[i].trigger_s - (*captures)[i - 1].trigger_s;
        EXPECT_IN_TIME(std::abs(apart_s - 0.5) <= 0.25) << apart_s;
    }
}

/// The loop hears nothing for 50 ms before the device's thread gives up; what it heard before decides the cause.
TEST_F(RealTimeBenchTest, ADeviceThatSaysThatItGoesOnIsStuckOnAndNotSilent) {
    RecordProperty("hazard", "H2");
    for (int trial = 0; trial < 3; ++trial) {
        open({"sim:stimulator?fault=stuck-on@0.4s"}, {Role::Stimulator}, true);
        ASSERT_IN_TIME(arm());
        ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 1, 1));
        const auto waited = bench_->wait(Seconds(3));
        ASSERT_FALSE(waited);
        const bool known = bench_->telemetry().fault == FaultCause::StuckOn;
        EXPECT_IN_TIME(known) << waited.error().message;
        EXPECT_IN_TIME(waited.error().message.ends_with("The output may still be on.")) << waited.error().message;
    }
}

TEST_F(RealTimeBenchTest, ACauseThatComesAfterTheFaultIsShownToo) {
    RecordProperty("hazard", "H12");
    open({"sim:stimulator?fault=short@0.8s", "sim:finger?fault=unplug@1.8s"}, {Role::Sensor, Role::Stimulator}, true);
    ASSERT_IN_TIME(arm());
    ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_FALSE(bench_->wait(Seconds(1.5)));
    EXPECT_IN_TIME(bench_->telemetry().fault == FaultCause::ShortElectrode);
    const auto until = steady_clock::now() + 5s;
    while (bench_->telemetry().fault != FaultCause::DeviceFault && steady_clock::now() < until)
        std::this_thread::sleep_for(10ms);
    EXPECT_IN_TIME(bench_->telemetry().fault == FaultCause::DeviceFault) << "the fingertip was unplugged";
}

TEST_F(RealTimeBenchTest, StopReachesForceOffWithinTenMilliseconds) {
    RecordProperty("hazard", "H2");
    constexpr int kStops = 200;
    open({}, {Role::Stimulator}, true);
    std::vector<steady_clock::duration> took;
    for (int i = 0; i < kStops; ++i) {
        ASSERT_IN_TIME(bench_->begin(bench_->stops().mark()));
        ASSERT_IN_TIME(arm());
        ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 1, 1));
        ASSERT_IN_TIME(bench_->wait(i == 0 ? Seconds(0.3) : Seconds(0.005)));
        const auto before = state();
        ASSERT_IN_TIME(before == InterlockState::Armed || before == InterlockState::Delivering);
        if (i == 0) {
            EXPECT_IN_TIME(before == InterlockState::Delivering);
        }
        const auto begun = steady_clock::now();
        bench_->stop("test");  // returns after forceOff
        took.push_back(steady_clock::now() - begun);
        ASSERT_EQ(state(), InterlockState::Disarmed);
    }
    ASSERT_EQ(took.size(), std::size_t{kStops}) << "each of them of a bench that was armed and driven";
    std::ranges::sort(took);
    const auto microseconds = [&](std::size_t percent) {
        return std::chrono::duration<double, std::micro>(took[took.size() * percent / 100]).count();
    };
    RecordProperty("armed_stops", std::to_string(took.size()));
    RecordProperty("median_us", std::to_string(microseconds(50)));
    RecordProperty("p95_us", std::to_string(microseconds(95)));
    EXPECT_IN_TIME(microseconds(95) < 10'000) << microseconds(95) << " µs, p95 of " << took.size() << " armed stops";
}

TEST_F(RealTimeBenchTest, StopEndsAWaitAtOnce) {
    RecordProperty("hazard", "H2");
    open({}, {Role::Stimulator}, true);
    steady_clock::time_point ended;
    std::thread waiter([&] {
        EXPECT_FALSE(bench_->wait(Seconds(60)));
        ended = steady_clock::now();
    });
    std::this_thread::sleep_for(30ms);
    const auto begun = steady_clock::now();
    bench_->stop("test");
    waiter.join();
    EXPECT_IN_TIME(ended - begun < 500ms);  // 2 ms on an idle machine
}

TEST_F(RealTimeBenchTest, DisarmingEndsTheDriveToo) {
    RecordProperty("hazard", "H2");
    open({}, {Role::Stimulator}, true);
    ASSERT_IN_TIME(arm());
    ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 1, 1));
    ASSERT_IN_TIME(bench_->wait(Seconds(0.2)));
    bench_->disarm();
    const auto delivered = bench_->telemetry().trainsDelivered;
    ASSERT_IN_TIME(arm());
    ASSERT_IN_TIME(bench_->wait(Seconds(1.2)));
    EXPECT_EQ(bench_->telemetry().trainsDelivered, delivered) << "armed again, and drive() was not called";
}

TEST_F(RealTimeBenchTest, ClosesWithEverythingRunning) {
    for (int i = 0; i < 3; ++i) {
        open({}, {Role::Sensor, Role::Stimulator, Role::Oscilloscope}, true);
        ASSERT_IN_TIME(arm());
        ASSERT_IN_TIME(bench_->drive(DriveSource::Manual, 1, 1));
        ASSERT_IN_TIME(bench_->wait(Seconds(0.05)));
        bench_.reset();
    }
}

}  // namespace
}  // namespace tacto
