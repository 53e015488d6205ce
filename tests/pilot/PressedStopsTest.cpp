// Stops that were not handled yet: each is known by what pressed it, and taken once.
#include <gtest/gtest.h>

#include "core/pilot/PressedStops.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;

TEST(PressedStops, APressIsTakenOnceWithWhoseItWasAndHowLongItTook) {
    RecordProperty("hazard", "H2");
    PressedStops stops;
    EXPECT_FALSE(stops.any());
    for (const bool participants : {true, false}) {
        stops.note(participants ? kParticipantLetGo : "operator");
        stops.noteTook(3ms);
        EXPECT_TRUE(stops.any());
        const auto press = stops.takePress();
        ASSERT_TRUE(press);
        EXPECT_EQ(press->participants, participants);
        EXPECT_EQ(press->took, 3ms);
        EXPECT_FALSE(stops.takePress());
        EXPECT_FALSE(stops.any());
    }
}

TEST(PressedStops, AScreenAPauseAndAnAbortAreNoPress) {
    RecordProperty("hazard", "H2");
    PressedStops stops;
    stops.note("the participant's screen went");
    stops.note(kOperatorPauses);
    EXPECT_EQ(stops.by(), nullptr);
    EXPECT_TRUE(stops.takeScreenGone());
    EXPECT_FALSE(stops.takeScreenGone());
    EXPECT_TRUE(stops.any());
    EXPECT_TRUE(stops.takePaused());
    EXPECT_FALSE(stops.any());
    stops.note(kOperatorAborts);
    EXPECT_FALSE(stops.takePress());
    EXPECT_TRUE(stops.aborted());
    EXPECT_TRUE(stops.any());
}

}  // namespace
}  // namespace tacto::test
