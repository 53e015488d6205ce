// The worst case that a run's limits are shown with before it begins.
#include <QElapsedTimer>
#include <gtest/gtest.h>

#include "app/gui/runner/WorstCase.h"
#include "tests/gui/runner/Lab.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

TEST(WorstCase, NamesTheLimitThatIsBrokenAndIsQuickEnoughForTheWindow) {
    const auto profile = shippedProfile().value();
    const auto limits = shippedLimits().value();
    QElapsedTimer timer;
    timer.start();
    const auto kept = gui::worstCase(profile, limits.sets, "1000 ohm").value();
    EXPECT_IN_TIME(timer.elapsed() < 100) << "it is worked out on the window's thread";
    EXPECT_TRUE(kept.refused.isEmpty()) << kept.refused.toStdString();
    EXPECT_GT(kept.rows.size(), 5U);
    EXPECT_FALSE(gui::worstCase(profile, limits.sets, "10 ohm").value().refused.isEmpty());
    EXPECT_FALSE(gui::worstCase(profile, limits.sets, "nonsense"));
    RecordProperty("microseconds", int(timer.nsecsElapsed() / 3000));
}

}  // namespace
}  // namespace tacto::test
