#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "core/analysis/psychophysics/LevelGrid.h"
#include "tests/analysis/psychophysics/Procedures.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

TEST(LevelGrid, EndsAtTheLowestCeilingAndNamesIt) {
    const std::vector<LevelCeiling> ceilings = {
        {15, LevelLimit::Cap}, {11.3, LevelLimit::Gate}, {100, LevelLimit::Device}};
    const auto grid = test::accepted(LevelGrid::create(LevelUnit::Current, 0.5, ceilings));
    EXPECT_EQ(grid.count(), 22U);
    EXPECT_EQ(grid.highest(), 11);
    EXPECT_EQ(grid.limitedBy(), LevelLimit::Gate);
}

TEST(LevelGrid, CountsWhatLiesOnALevelAsOnIt) {
    const auto grid = test::gridUpTo(0.3, 0.1);  // 0.3 / 0.1 is 2.9999999999999996
    EXPECT_EQ(grid.count(), 3U);
    EXPECT_EQ(grid.atOrBelow(0.3), 3U);
    EXPECT_EQ(grid.atOrAbove(0.1 + 0.2), 3U);
}

TEST(LevelGrid, FindsTheNeighboursOfAValue) {
    const auto grid = test::gridUpTo(10);
    EXPECT_EQ(grid.atOrBelow(0.4), 0U);
    EXPECT_EQ(grid.atOrBelow(3.9), 7U);
    EXPECT_EQ(grid.atOrBelow(99), 20U);
    EXPECT_EQ(grid.atOrAbove(3.6), 8U);
    EXPECT_EQ(grid.atOrAbove(10), 20U);
    EXPECT_FALSE(grid.atOrAbove(10.1));
    EXPECT_EQ(grid.nearest(0.01), 1U);
    EXPECT_EQ(grid.nearest(4.74), 9U);
    EXPECT_EQ(grid.nearest(4.75), 9U) << "of two equally near the weaker";
    EXPECT_EQ(grid.nearest(4.76), 10U);
    EXPECT_EQ(grid.nearest(99), 20U);
}

TEST(LevelGrid, RefusesWhatIsNoGrid) {
    const auto refusal = [](LevelUnit unit, double step, std::vector<LevelCeiling> ceilings) {
        const auto grid = LevelGrid::create(unit, step, ceilings);
        return grid ? std::string() : grid.error().message;
    };
    const LevelCeiling ten{10, LevelLimit::Cap};
    for (const double step : {0.0, -0.5, std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_NE(refusal(LevelUnit::Current, step, {ten}), "") << step;
    }
    EXPECT_NE(refusal(LevelUnit::Current, 0.5, {}), "");
    EXPECT_NE(refusal(LevelUnit::Current, 0.5, {ten, {std::nan(""), LevelLimit::Gate}}), "");
    EXPECT_NE(refusal(LevelUnit::Current, 0.0001, {ten}), "");
    EXPECT_EQ(refusal(LevelUnit::Current, 0.5, {{0.4, LevelLimit::Gate}}),
              "the highest level (gate) is 0.4; at least one step of 0.5 is accepted");
    EXPECT_EQ(refusal(LevelUnit::Intensity, 0.1, {{1.5, LevelLimit::Cap}}),
              "the highest intensity (cap) is 1.5; at most 1 is accepted");
    EXPECT_NE(refusal(LevelUnit::Intensity, 2, {{1, LevelLimit::Cap}}), "");
}

}  // namespace
}  // namespace tacto
