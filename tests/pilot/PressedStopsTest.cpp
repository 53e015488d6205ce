// Stops that were not handled yet: each is known by what pressed it, and taken once.
#include <atomic>
#include <gtest/gtest.h>
#include <latch>
#include <thread>

#include "core/pilot/PressedStops.h"

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
        const auto press = stops.takePress();
        ASSERT_TRUE(press);
        EXPECT_EQ(press->participants, participants);
        EXPECT_GE(press->took, 3ms);
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

// Otherwise it would be handled first and take effect afterwards: the output's stop would have no name, which breaks a
// session off, and a STOP's test would read the time of the press before.
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

}  // namespace
}  // namespace tacto::test
