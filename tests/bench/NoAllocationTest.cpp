// The control loop in its steady state allocates no memory.
#include <gtest/gtest.h>

#include "tests/bench/LoopRig.h"
#include "tests/support/Allocations.h"

namespace tacto {
namespace {

TEST(ControlLoop, TakesNoMemoryInItsSteadyState) {
    if (!test::countsAllocations()) GTEST_SKIP() << test::kNotCounted;
    test::LoopRig rig;
    const auto turn = [&rig] {
        rig.nextSamples();
        rig.loop.step(rig.clock.now());
        rig.serveStimulator();
    };
    for (int i = 0; i < 1000; ++i) turn();  // 5 s: baseline, contact, the first trains
    ASSERT_GT(rig.loop.telemetry().trainsDelivered, 1U) << rig.loop.telemetry().lastRefusal.view();

    const auto deliveredBefore = rig.loop.telemetry().trainsDelivered;
    const auto before = test::allocationsOfThisThread();
    for (int i = 0; i < 2000; ++i) turn();
    EXPECT_EQ(test::allocationsOfThisThread() - before, 0U);
    EXPECT_GT(rig.loop.telemetry().trainsDelivered, deliveredBefore);
}

}  // namespace
}  // namespace tacto
