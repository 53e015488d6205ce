// A ramp reaches accepted levels again from the weakest up, but none above the settled level or a level too strong.
#include "core/pilot/PilotOutput.h"
#include "tests/pilot/StageFixture.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class LevelRampTest : public PilotStageTest {
protected:
    /// Accepts levels in the way in which a resumed session does.
    void accepted(LevelRamp& ramp) {
        for (const double level : {1.0, 0.5, 1.5})
            ASSERT_TRUE(ramp.judged(level, false, fmt::format("ascending {}", level), true));
    }
    [[nodiscard]] std::vector<double> presented() const {
        std::vector<double> all;
        for (const auto& body : bodies(row::kTrialBegin)) all.push_back(body["current_ma"]);
        return all;
    }
};

TEST_F(LevelRampTest, PresentsNothingUntilItIsDue) {
    LevelRamp ramp(*stage_, false);
    ASSERT_NO_FATAL_FAILURE(accepted(ramp));
    ASSERT_TRUE(ramp.reach());
    EXPECT_THAT(presented(), IsEmpty());
}

TEST_F(LevelRampTest, RisesFromTheWeakestOnceEachTimeThatItIsDue) {
    RecordProperty("hazard", "H6");
    LevelRamp ramp(*stage_, true);
    ASSERT_NO_FATAL_FAILURE(accepted(ramp));
    ASSERT_TRUE(ramp.reach());
    ASSERT_TRUE(ramp.reach());
    EXPECT_THAT(presented(), ElementsAre(0.5, 1.0, 1.5));
    ramp.becomeDue();
    ASSERT_TRUE(ramp.reach());
    EXPECT_THAT(presented(), ElementsAre(0.5, 1.0, 1.5, 0.5, 1.0, 1.5));
}

TEST_F(LevelRampTest, EndsAtWhatWasSettledAndBelowWhatWasTooStrong) {
    RecordProperty("hazard", "H6");
    LevelRamp ramp(*stage_, true);
    ASSERT_NO_FATAL_FAILURE(accepted(ramp));
    ramp.settle(1.0);
    ASSERT_TRUE(ramp.reach());
    EXPECT_THAT(presented(), ElementsAre(0.5, 1.0));
    ASSERT_TRUE(ramp.judged(1.0, true, "ascending 1", true));
    ramp.becomeDue();
    ASSERT_TRUE(ramp.reach());
    EXPECT_THAT(presented(), ElementsAre(0.5, 1.0, 0.5));
}

}  // namespace
}  // namespace tacto::test
