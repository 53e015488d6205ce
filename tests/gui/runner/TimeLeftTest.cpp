// Tests the estimate of a run's remaining time, which uses the number of steps.
#include <gtest/gtest.h>

#include "app/gui/runner/RunPanel.h"

namespace tacto::test {
namespace {

ScriptProgress at(std::size_t done, std::size_t total = 10) { return {"Steps", done, total}; }

TEST(TimeLeft, IsNotKnownBeforeAStepIsThrough) {
    gui::TimeLeft left;
    left.note(at(0), false, 5);
    EXPECT_FALSE(left.seconds());
    left.note(at(0), false, 7);
    EXPECT_FALSE(left.seconds());
}

TEST(TimeLeft, CountsNeitherWhatCameBeforeTheFirstStepNorPauses) {
    gui::TimeLeft left;
    left.note(at(0), false, 100);
    left.note(at(1), false, 102);
    EXPECT_DOUBLE_EQ(left.seconds().value(), 18);
    left.note(at(1), true, 160);
    left.note(at(2), false, 162);
    EXPECT_DOUBLE_EQ(left.seconds().value(), 16);
    left.note(at(2), false, 163);
    EXPECT_DOUBLE_EQ(left.seconds().value(), 15) << "the step under way has had a second";
}

TEST(TimeLeft, BeginsAnewWithAnotherList) {
    gui::TimeLeft left;
    left.note(at(0), false, 0);
    left.note(at(5), false, 5);
    left.note({"Others", 0, 4}, false, 6);
    EXPECT_FALSE(left.seconds());
}

}  // namespace
}  // namespace tacto::test
