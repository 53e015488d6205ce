#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/psychophysics/PersonalRange.h"
#include "tests/analysis/psychophysics/Procedures.h"

namespace tacto {
namespace {

PersonalRange rangeOf(double detection, double tooStrong, const LevelGrid& grid = test::gridUpTo(15)) {
    return PersonalRange::create(grid, {.detection = detection, .tooStrong = tooStrong}).value();
}

TEST(PersonalRange, LiesBetweenWhatIsFeltAndWhatIsTooStrong) {
    auto range = rangeOf(3.1, 9);
    EXPECT_FALSE(range.done());
    EXPECT_FALSE(range.result().usable) << "not confirmed yet";
    EXPECT_EQ(range.next(), 7);  // 0.8 times 9 is 7.2
    ASSERT_TRUE(range.answer(true));
    const auto result = range.result();
    EXPECT_TRUE(range.done());
    EXPECT_TRUE(result.usable);
    EXPECT_EQ(result.reason, "");
    EXPECT_EQ(result.min, 4);  // 1.25 times 3.1 is 3.875
    EXPECT_EQ(result.max, 7);
    EXPECT_EQ(result.steps, 6U);
    EXPECT_EQ(result.limitedBy, LevelLimit::TooStrong);
    EXPECT_NEAR(result.jnd, std::log(7.0 / 4) / std::log(1.1), 1e-12);
    EXPECT_FALSE(range.answer(true));
}

TEST(PersonalRange, FallsByAStepAtEachNo) {
    RecordProperty("hazard", "H6");
    auto range = rangeOf(3.1, 9);
    EXPECT_EQ(range.next(), 7);
    ASSERT_TRUE(range.answer(false));
    EXPECT_EQ(range.next(), 6.5);
    ASSERT_TRUE(range.answer(false));
    EXPECT_EQ(range.next(), 6);
    ASSERT_TRUE(range.answer(true));
    EXPECT_EQ(range.result().max, 6);
    EXPECT_EQ(range.result().lowered, 2U);
    EXPECT_EQ(range.result().limitedBy, LevelLimit::Confirmation);
}

TEST(PersonalRange, IsNotUsableWithFewerThanTwoSteps) {
    auto range = rangeOf(3.1, 6.3);  // from 4 to 5
    EXPECT_EQ(range.next(), 5);
    ASSERT_TRUE(range.answer(false));
    EXPECT_TRUE(range.done());
    EXPECT_FALSE(range.next());
    const auto result = range.result();
    EXPECT_FALSE(result.usable);
    EXPECT_TRUE(std::isnan(result.jnd));
    EXPECT_EQ(result.steps, 1U);
    EXPECT_EQ(
        result.reason,
        "from the lowest level of 4 mA to the highest of 4.5 mA, limited by what they would feel for half an hour, "
        "the device has 1 step; 2 "
        "or more are needed");
    EXPECT_FALSE(range.answer(true));
    EXPECT_TRUE(rangeOf(3.1, 5.6).done()) << "asked nothing: 4 to 4 mA";
    EXPECT_TRUE(rangeOf(3.1, 1).done());
}

TEST(PersonalRange, NamesWhatLimitsIt) {
    const std::vector<LevelCeiling> ceilings = {{15, LevelLimit::Cap}, {6.2, LevelLimit::Gate}};
    const auto grid = LevelGrid::create(LevelUnit::Current, 0.5, ceilings).value();
    auto range = rangeOf(3.1, 9, grid);
    EXPECT_EQ(range.next(), 6);
    EXPECT_EQ(range.result().limitedBy, LevelLimit::Gate);
    // Nothing was too strong, so the limit is the highest level presented, 6 mA, which the gate permits.
    auto unbothered = PersonalRange::create(grid, {.detection = 2, .tooStrong = 6, .saidTooStrong = false}).value();
    EXPECT_EQ(unbothered.next(), 4.5);
    EXPECT_EQ(unbothered.result().limitedBy, LevelLimit::Gate);
    const auto above = rangeOf(6, 9, grid).result();
    EXPECT_FALSE(above.usable);
    EXPECT_TRUE(std::isnan(above.min));
    EXPECT_EQ(above.reason, "the lowest level would be 7.5 mA, above the highest of 6 mA, limited by the safety gate");
}

TEST(PersonalRange, ServesMassagers) {
    auto range = rangeOf(0.2, 0.6, test::intensities(0.05));
    EXPECT_NEAR(range.next().value(), 0.45, 1e-12);
    ASSERT_TRUE(range.answer(true));
    EXPECT_NEAR(range.result().min, 0.25, 1e-12);
    EXPECT_EQ(range.result().steps, 4U);
}

TEST(PersonalRange, RefusesWhatIsNoThreshold) {
    const auto grid = test::gridUpTo(15);
    for (const double bad : {0.0, -3.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_FALSE(PersonalRange::create(grid, {.detection = bad, .tooStrong = 9})) << bad;
        EXPECT_FALSE(PersonalRange::create(grid, {.detection = 3, .tooStrong = bad})) << bad;
        EXPECT_FALSE(PersonalRange::create(grid, {.detection = 3, .tooStrong = 9, .weber = bad})) << bad;
    }
    EXPECT_FALSE(PersonalRange::create(grid, {.detection = 3, .tooStrong = 9, .aboveDetection = 0.9}));
    EXPECT_FALSE(PersonalRange::create(grid, {.detection = 3, .tooStrong = 9, .belowTooStrong = 1.1}));
    EXPECT_FALSE(PersonalRange::create(grid, {.detection = 3, .tooStrong = 9, .leastSteps = 0}));
}

}  // namespace
}  // namespace tacto
