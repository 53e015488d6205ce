// Tests that the path of a session shows no step as done that does not exist in the session.
#include <QLabel>
#include <gmock/gmock.h>

#include "app/gui/pilot/SessionPath.h"
#include "app/gui/runner/StepList.h"
#include "tests/gui/Person.h"

namespace tacto::test {
namespace {

using gui::SessionEnd;
using State = gui::StepList::State;
using testing::AllOf;
using testing::Contains;
using testing::Not;

class PathOfASession : public testing::Test {
protected:
    PathOfASession() { path.setVisible(true); }
    [[nodiscard]] std::vector<std::string> steps() const {
        std::vector<std::string> names;
        for (const auto* button : path.findChildren<QAbstractButton*>())
            if (button->isVisible()) names.push_back(button->text().toStdString());
        return names;
    }
    [[nodiscard]] State stateOf(int step) const { return path.findChild<gui::StepList*>()->state(step); }
    [[nodiscard]] std::string timeLeft() const { return find<QLabel>(path, "timeLeft")->text().toStdString(); }
    static constexpr int kThresholds = 3, kTraining = 4, kTest = 5, kRatings = 6, kAfter = 7;
    gui::SessionPath path;
};

TEST_F(PathOfASession, WithATestLeadsThroughIt) {
    path.begin(gui::kUsualBlocks, true, false);
    EXPECT_THAT(steps(), AllOf(Contains("Training"), Contains("Test"), Contains("Ratings")));
    EXPECT_EQ(timeLeft(), "about 66 min");
    EXPECT_EQ(gui::sessionLasts(gui::kUsualBlocks), "about 66 min") << "said before it begins";
    path.end(SessionEnd::Complete);
    EXPECT_EQ(stateOf(kTest), State::Done);
}

TEST_F(PathOfASession, OfThresholdsAloneHasNoTestAndCountsNoTimeForIt) {
    path.begin(0, true, true);
    EXPECT_THAT(steps(), AllOf(Contains("Thresholds and range"), Not(Contains("Training")), Not(Contains("Test")),
                               Not(Contains("Ratings"))));
    EXPECT_EQ(timeLeft(), "about 27 min");
    EXPECT_EQ(gui::sessionLasts(0), "about 27 min");
    path.clear();
    EXPECT_THAT(steps(), Contains("Test")) << "the next session may have one";
}

TEST_F(PathOfASession, CountsTheBlocksThatTheSessionHas) {
    path.begin(gui::kUsualBlocks, true, false);
    path.count({.answers = 0, .voided = 0, .blocks = 3});
    EXPECT_EQ(timeLeft(), "about 55 min") << "as that of 66 min with 3 of 5 blocks of its 28 min";
    PilotScreen screen;
    screen.phase = "test";
    screen.block = 3;
    screen.blocks = 3;
    screen.trial = 54;
    screen.trials = 54;
    path.show(screen);
    EXPECT_EQ(timeLeft(), "about 8 min") << "the last trial, ratings, skin";
    path.begin(0, true, false);
    path.count({.answers = 0, .voided = 0, .blocks = 5});
    EXPECT_EQ(timeLeft(), "about 27 min") << "thresholds alone have no blocks";
}

TEST_F(PathOfASession, WithoutAUsableRangeDidNotRunItsTest) {
    path.begin(gui::kUsualBlocks, true, false);
    path.end(SessionEnd::NoRange);
    EXPECT_EQ(stateOf(kThresholds), State::Done);
    for (const int step : {kTraining, kTest, kRatings}) EXPECT_EQ(stateOf(step), State::ToDo) << step;
    EXPECT_EQ(stateOf(kAfter), State::Done);
}

}  // namespace
}  // namespace tacto::test
