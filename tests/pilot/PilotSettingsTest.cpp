// How a participant's range and the study's encoding make the four conditions.
#include <gtest/gtest.h>

#include "core/pilot/PilotSettings.h"

namespace tacto {
namespace {

TEST(PresentedConditions, AreTheEndsOfTheRangeAndOfTheIntervals) {
    const auto all = presentedConditions({}, 3.5, 7, 0.5);
    ASSERT_EQ(all.size(), 4U);
    const struct {
        const char* name;
        double level, interval;
    } expected[] = {{"smooth-low", 3.5, 2}, {"smooth-high", 3.5, 0.5}, {"rough-low", 7, 2}, {"rough-high", 7, 0.5}};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(all[i].name, expected[i].name);
        EXPECT_EQ(all[i].level, expected[i].level);
        EXPECT_EQ(all[i].interval.count(), expected[i].interval);
    }
}

TEST(PresentedConditions, SwappedPressureIsTheLevelAndTextureTheInterval) {
    PilotSettings settings;
    settings.assignment = Assignment::Swapped;
    const auto all = presentedConditions(settings, 3.5, 7, 0.5);
    EXPECT_EQ(all[1].name, "smooth-high");
    EXPECT_EQ(all[1].level, 7);
    EXPECT_EQ(all[1].interval.count(), 2);
    EXPECT_EQ(all[2].level, 3.5);
    EXPECT_EQ(all[2].interval.count(), 0.5);
}

TEST(PresentedConditions, BetweenTheEndsLieOnTheDevicesGrid) {
    PilotSettings settings;
    settings.conditions = {{"middle", 0.4, 0.5}};
    const auto all = presentedConditions(settings, 3.5, 7, 0.5);
    EXPECT_NEAR(all[0].level, 5, 1e-9);
    EXPECT_NEAR(all[0].interval.count(), 1.25, 1e-9);
}

}  // namespace
}  // namespace tacto
