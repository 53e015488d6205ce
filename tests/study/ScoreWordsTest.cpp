#include <gtest/gtest.h>

#include "core/study/NextDay.h"
#include "core/study/ScoreWords.h"

namespace tacto {
namespace {

TEST(ScoreWords, AreShownBesideTheirNumbers) {
    EXPECT_EQ(scoreText(kEventSeverities, 3), "3 severe");
    EXPECT_EQ(scoreText(kSkinScores, 0, 0), "0 none");
    for (const int none : {-1, 0, 5, 100}) EXPECT_EQ(scoreText(kEventSeverities, none), std::to_string(none));
    EXPECT_EQ(scaleText(kEventSeverities), "1 mild, 2 moderate, 3 severe, 4 life-threatening");
    EXPECT_EQ(scaleText(kRelations), "1 none, 2 remote, 3 possible, 4 probable, 5 definite");
    EXPECT_EQ(scaleText(kSkinScores, 0), "0 none, 1 very slight, 2 well defined, 3 moderate, 4 severe");
}

TEST(ScoreWords, SkinIsAnEventNoMilderThanItScoresAndNeverLifeThreatening) {
    RecordProperty("hazard", "H12");
    EXPECT_EQ(severityOfSkin(kSkinIsAdverse), 2);
    EXPECT_EQ(severityOfSkin(3), 3);
    EXPECT_EQ(severityOfSkin(4), 3);
}

}  // namespace
}  // namespace tacto
