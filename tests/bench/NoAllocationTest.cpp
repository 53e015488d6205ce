// The control loop in its steady state takes no memory.
#include <gtest/gtest.h>

#include "core/bench/ControlLoop.h"
#include "core/bench/Profile.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/bench/TapedFinger.h"
#include "tests/support/Allocations.h"

namespace tacto {
namespace {

using namespace std::chrono_literals;

TEST(ControlLoop, TakesNoMemoryInItsSteadyState) {
    if (!test::countsAllocations()) GTEST_SKIP() << test::kNotCounted;
    VirtualClock clock;
    SafetyGate gate(clock);
    Interlock interlock;
    Heartbeat heartbeat;
    test::FakeStimulator device(clock);
    StimulatorSession stimulator(device, gate, heartbeat, clock, {});
    test::TapedFinger finger(clock);
    auto sensor = SensorSession::create(finger).value();
    const Profile profile;
    ControlLoop loop({clock, gate, interlock, heartbeat, OutputMode::BenchLoad, &stimulator, nullptr, 0, {}},
                     FingerInput::create(*sensor, profile.roughness).value(),
                     std::make_unique<TrainPlanner>(profile.encoding, device.traits(), gate));
    test::armFake(loop, interlock, device, clock);
    loop.drive({DriveSource::Sensor, 0, 0});

    const auto turn = [&] {
        clock.advanceTo(clock.now() + ControlLoop::kPeriod);
        sensor->serve(clock.now());
        loop.step(clock.now());
        stimulator.serve(clock.now());
        stimulator.serve(clock.now());
    };
    for (int i = 0; i < 1000; ++i) turn();  // 5 s: baseline, contact, the first trains
    ASSERT_GT(loop.telemetry().trainsDelivered, 1U) << loop.telemetry().lastRefusal.view();

    const auto deliveredBefore = loop.telemetry().trainsDelivered;
    const auto before = test::allocationsOfThisThread();
    for (int i = 0; i < 2000; ++i) turn();
    EXPECT_EQ(test::allocationsOfThisThread() - before, 0U);
    EXPECT_GT(loop.telemetry().trainsDelivered, deliveredBefore);
}

}  // namespace
}  // namespace tacto
