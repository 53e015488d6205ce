// What the time cursors read stands beside them, inside the screen, off each other and off the traces.
#include <gtest/gtest.h>

#include "app/gui/scope/screen/TimeFlags.h"

namespace tacto::test {
namespace {

using gui::OverlayState;

class TimeFlagsTest : public testing::Test {
protected:
    TimeFlagsTest() : plane_(plot_.xAxis, plot_.yAxis) {
        plot_.resize(1000, 700);
        plot_.xAxis->setRange(0, 10);
        plot_.yAxis->setRange(-4, 4);
        plot_.replot(QCustomPlot::rpImmediateRefresh);
        for (const auto* name : {"t₁", "t₂"}) {
            OverlayState::Flag flag;
            flag.name = name;
            flag.position = "200.0 µs";
            flag.rows = {{"V", "20.1 V", Qt::blue}, {"A", "20.1 mA", Qt::darkGreen}};
            state_.flags.push_back(flag);
        }
        state_.timeSpan = "Δt 4.0 s";
    }
    [[nodiscard]] std::vector<QRectF> boxesAt(double first_s, double second_s) {
        state_.timeCursors_s = {first_s, second_s};
        return gui::TimeFlags(plane_, state_).boxes();
    }

    QCustomPlot plot_;
    gui::ScopePlane plane_;
    OverlayState state_;
};

TEST_F(TimeFlagsTest, StandOutsideWhatTheCursorsEnclose) {
    const auto boxes = boxesAt(3, 7);
    ASSERT_EQ(boxes.size(), 2U);
    EXPECT_LE(boxes[0].right(), plane_.x(3) + 1);
    EXPECT_GE(boxes[1].left(), plane_.x(7) - 1);
}

TEST_F(TimeFlagsTest, StayInsideTheScreenAndOffEachOther) {
    for (const auto& [first, second] : {std::pair(0.0, 10.0), std::pair(-5.0, 15.0), std::pair(5.0, 5.0)}) {
        const auto boxes = boxesAt(first, second);
        ASSERT_EQ(boxes.size(), 2U);
        for (const auto& box : boxes) EXPECT_TRUE(plane_.area().adjusted(-1, -1, 1, 1).contains(box)) << first;
        EXPECT_FALSE(boxes[0].intersects(boxes[1])) << first;
    }
}

TEST_F(TimeFlagsTest, GoOffTheTraces) {
    const auto free = boxesAt(3, 7);
    const double top = 4;
    state_.drawn = {{0, 10, 0.5, top}};  // the upper half is full
    const auto moved = boxesAt(3, 7);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LT(free[i].top(), plane_.y(0.5)) << i;
        EXPECT_GE(moved[i].top(), plane_.y(0.5)) << i;
    }
}

TEST_F(TimeFlagsTest, ThereAreNoneWithoutCursors) {
    state_.flags.clear();
    EXPECT_TRUE(gui::TimeFlags(plane_, state_).boxes().empty());
}

}  // namespace
}  // namespace tacto::test
