// Requests from other threads to the control loop: the newest of each kind arrives once, and none is lost.
#include <atomic>
#include <gtest/gtest.h>
#include <thread>

#include "core/bench/LoopInbox.h"
#include "core/bench/Profile.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/bench/TapedFinger.h"

namespace tacto {
namespace {

SeenAmplitude amplitudeOf(double amplitude) {
    SeenAmplitude seen;
    seen.amplitude = amplitude;
    seen.expected = 10;
    return seen;
}

TEST(LoopInbox, TheNewestOfEachKindIsTakenOnce) {
    RecordProperty("hazard", "H2");
    LoopInbox inbox;
    EXPECT_FALSE(inbox.take());
    ArmCommand first, second;
    first.declared = Ohms(1);
    second.declared = Ohms(2);
    inbox.arm(first);
    inbox.arm(second);
    inbox.drive({DriveSource::Manual, 0.5, 0.5});
    inbox.drive({});  // as sent by a stop, after a request
    inbox.confirm(Ohms(100));
    inbox.confirm(fail(ErrorCode::NotArmed, "another pulse"));
    inbox.load({Ohms(1), false, Instant(1)});
    inbox.load({Ohms(2), true, Instant(2)});

    const auto taken = inbox.take();
    ASSERT_TRUE(taken);
    ASSERT_TRUE(taken->arm && taken->drive && taken->confirmed && taken->load);
    EXPECT_EQ(taken->arm->declared, Ohms(2));
    EXPECT_EQ(taken->drive->source, DriveSource::Off);
    ASSERT_FALSE(*taken->confirmed);
    EXPECT_EQ(taken->confirmed->error().message, "another pulse");
    EXPECT_EQ(taken->load->impedance, Ohms(2));
    EXPECT_FALSE(taken->finger || taken->planner || taken->amplitude);
    EXPECT_FALSE(inbox.take());
}

TEST(LoopInbox, OfSeveralAmplitudesTheOneFarthestOffIsJudged) {
    RecordProperty("hazard", "H1");
    LoopInbox inbox;
    for (const double amplitude : {10.1, 6.0, 13.0, 10.0}) inbox.amplitude(amplitudeOf(amplitude));
    const auto taken = inbox.take();
    ASSERT_TRUE(taken && taken->amplitude);
    EXPECT_EQ(taken->amplitude->amplitude, 6.0);
    inbox.amplitude(amplitudeOf(10.1));
    EXPECT_EQ(inbox.take()->amplitude->amplitude, 10.1) << "what was taken before is gone";
}

TEST(LoopInbox, OfTwoFingersTheSecondIsTakenWithWhatRWasForBeforeTheFirst) {
    VirtualClock clock;
    test::TapedFinger device(clock);
    const auto session = SensorSession::create(device).value();
    const auto make = [&] { return FingerInput::create(*session, Profile{}.roughness).value(); };
    LoopInbox inbox;
    inbox.finger({make(), RBefore::Shown});
    auto newest = make();
    const auto* const expected = newest.get();
    inbox.finger({std::move(newest), RBefore::Measuring});
    auto taken = inbox.take();
    ASSERT_TRUE(taken && taken->finger);
    EXPECT_EQ(taken->finger->finger.get(), expected);
    EXPECT_EQ(taken->finger->before, RBefore::Shown);

    inbox.finger({make(), RBefore::Measuring});
    inbox.drive({DriveSource::Sensor, 0, 0});
    const auto last = inbox.takeFinger();
    ASSERT_TRUE(last);
    EXPECT_EQ(last->before, RBefore::Measuring) << "the step between has used the one before";
    taken = inbox.take();
    ASSERT_TRUE(taken && taken->drive) << "taking the finger leaves the rest";
    EXPECT_FALSE(taken->finger);
}

TEST(LoopInbox, ThreadsHandInWhileTheLoopTakes) {
    constexpr int kEach = 20'000;
    LoopInbox inbox;
    std::atomic<int> running{2};
    std::thread driving([&] {
        for (int i = 1; i <= kEach; ++i) inbox.drive({DriveSource::Manual, i / double(kEach), 0});
        --running;
    });
    std::thread looking([&] {
        for (int i = 1; i <= kEach; ++i) inbox.load({Ohms(i), false, Instant(i)});
        --running;
    });
    double driven = 0, seen = 0;
    int back = 0;
    const auto take = [&] {
        const auto taken = inbox.take();
        if (!taken) return;
        if (taken->drive) back += std::exchange(driven, taken->drive->roughness) >= taken->drive->roughness;
        if (taken->load) back += std::exchange(seen, taken->load->impedance.value()) >= taken->load->impedance.value();
    };
    while (running > 0) take();
    driving.join();
    looking.join();
    take();  // no other thread is running, so the newest is not held back
    EXPECT_EQ(back, 0) << "a setting came twice, or after a newer one";
    EXPECT_EQ(driven, 1.0);
    EXPECT_EQ(seen, kEach);
    EXPECT_FALSE(inbox.take());
}

}  // namespace
}  // namespace tacto
