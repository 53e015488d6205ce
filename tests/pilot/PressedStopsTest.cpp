// Stops that were not handled yet: each keeps the name of its source and is taken once.
#include <atomic>
#include <gtest/gtest.h>
#include <latch>
#include <thread>

#include "core/pilot/PressedStops.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;

TEST(PressedStops, APressIsTakenOnceWithWhoseItWasAndHowLongItTook) {
    RecordProperty("hazard", "H2");
    PressedStops stops;
    EXPECT_FALSE(stops.any());
    for (const bool participants : {true, false}) {
        stops.press(participants ? kParticipantLetGo : "operator", [] { std::this_thread::sleep_for(3ms); });
        EXPECT_TRUE(stops.any());
        const auto press = accepted(stops.takePress());
        EXPECT_EQ(press.participants, participants);
        EXPECT_GE(press.took, 3ms);
        EXPECT_FALSE(stops.takePress());
        EXPECT_FALSE(stops.any());
    }
}

TEST(PressedStops, AScreenAPauseAndAnAbortAreNoPress) {
    RecordProperty("hazard", "H2");
    PressedStops stops;
    const auto press = [&stops](const char* by) { stops.press(by, [] {}); };
    press("the participant's screen went");
    press(kOperatorPauses);
    EXPECT_EQ(stops.by(), nullptr);
    EXPECT_TRUE(stops.takeScreenGone());
    EXPECT_FALSE(stops.takeScreenGone());
    EXPECT_TRUE(stops.any());
    EXPECT_TRUE(stops.takePaused());
    EXPECT_FALSE(stops.any());
    press(kOperatorAborts);
    EXPECT_FALSE(stops.takePress());
    EXPECT_TRUE(stops.aborted());
    EXPECT_TRUE(stops.any());
}

// Otherwise the session would handle the press too early: the output's stop would have no name, which would abort the
// session, and the test of a STOP would read the time of the previous press.
TEST(PressedStops, OneIsTakenAfterTheOutputWasTold) {
    RecordProperty("hazard", "H2");
    PressedStops stops;
    std::latch telling(1);
    std::atomic<bool> told{false};
    std::jthread presses([&] {
        stops.press("participant", [&] {
            telling.count_down();
            std::this_thread::sleep_for(20ms);
            told = true;
        });
    });
    telling.wait();
    const auto press = stops.takePress();
    EXPECT_TRUE(told);
    ASSERT_TRUE(press);
    EXPECT_TRUE(press->participants);
    EXPECT_GE(press->took, 20ms);
    EXPECT_FALSE(stops.any());
}

TEST(PressedStops, EachOfManyIsTakenOnceAndNeverBeforeTheOutputIsOff) {
    RecordProperty("hazard", "H2");
    constexpr int kPresses = 20'000;
    PressedStops stops;
    std::atomic<int> off{0};
    std::atomic<bool> taken{true};
    std::jthread presses([&](const std::stop_token& ends) {
        for (int i = 0; i < kPresses; ++i) {
            while (!taken.exchange(false) && !ends.stop_requested()) std::this_thread::yield();
            stops.press("participant", [&] { ++off; });
        }
    });
    for (int i = 1; i <= kPresses; ++i) {
        while (stops.takeBy() == nullptr) std::this_thread::yield();
        ASSERT_EQ(off, i);
        taken = true;
    }
}

TEST(PressedStops, AnotherThatComesNextDoesNotLendItsTime) {
    RecordProperty("hazard", "H2");
    PressedStops stops;
    stops.press("operator", [] { std::this_thread::sleep_for(15ms); });
    stops.press(kScreenGone, [] {});
    EXPECT_GE(stops.takePress()->took, 15ms);
}

}  // namespace
}  // namespace tacto::test
