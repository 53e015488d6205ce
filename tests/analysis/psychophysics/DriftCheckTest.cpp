#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/psychophysics/DriftCheck.h"
#include "tests/analysis/psychophysics/Procedures.h"

namespace tacto {
namespace {

DriftCheckSettings before(std::size_t block) { return {.felt = 3.5, .last = 3.1, .min = 4, .block = block}; }

/// Rests whenever it is asked to, after which thresholds are `afterRest` times the median participant's.
DriftResult checked(double risen, double afterRest, std::uint64_t seed) {
    auto check = DriftCheck::create(test::gridUpTo(10), before(2), seed).value();
    auto who = test::medianParticipant();
    while (!check.done()) {
        auto now = who;
        const double factor = check.result().rests == 0 ? risen : afterRest;
        now.detection = who.detection * factor;
        const auto observer = test::observerFor(now, seed + 1000 * check.result().rests);
        test::answerAll(check, observer);
        if (check.step() == DriftStep::Rest) {
            EXPECT_FALSE(check.next());
            EXPECT_FALSE(check.answer(TrialInterval::First));
            EXPECT_TRUE(check.rested());
        }
    }
    return check.result();
}

TEST(DriftCheck, LetsAParticipantGoOnWhoStillFeelsTheLowestLevel) {
    int rests = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto result = checked(1, 1, seed);
        EXPECT_EQ(result.checks.size(), result.rests + 1);
        EXPECT_EQ(result.checks[0].trials.size(), 12U);
        EXPECT_FALSE(result.adapted) << "seed " << seed;
        rests += static_cast<int>(result.rests);
    }
    EXPECT_LE(rests, 5);
}

TEST(DriftCheck, RestsThreeTimesAtMostAndThenSaysAdapted) {
    int adapted = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto result = checked(1.8, 1.8, seed);
        if (!result.adapted) continue;
        ++adapted;
        EXPECT_EQ(result.rests, 3U);
        EXPECT_EQ(result.checks.size(), 4U);
        EXPECT_GE(result.probability, 0.8);
    }
    EXPECT_GE(adapted, 95);
}

TEST(DriftCheck, GoesOnWhenTheRestHelped) {
    int recovered = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto result = checked(1.8, 1, seed);
        if (result.rests > 0 && !result.adapted) ++recovered;
    }
    EXPECT_GE(recovered, 90);
}

TEST(DriftCheck, JudgesTheProbabilityThatAlphaIsTooHigh) {
    auto check = DriftCheck::create(test::gridUpTo(10), before(3), 1).value();
    auto quest =
        QuestPlus::create(test::gridUpTo(10),
                          {.felt = 3.5, .prior = 3.1, .priorSd_db = 2.5, .first = 3.1, .least = 12, .most = 12}, 7)
            .value();
    for (int i = 0; i < 12; ++i) {
        const bool right = i % 3 != 0;
        EXPECT_EQ(check.next()->level, quest.next()->level);
        ASSERT_TRUE(quest.answer(right ? quest.next()->interval : test::other(quest.next()->interval)));
        ASSERT_TRUE(check.answer(right ? check.next()->interval : test::other(check.next()->interval)));
    }
    EXPECT_DOUBLE_EQ(check.result().probability, quest.probabilityAbove(4 / 1.1));
    EXPECT_DOUBLE_EQ(check.result().estimate.value, quest.result().estimate.value);
    EXPECT_EQ(check.step(), check.result().probability >= 0.8 ? DriftStep::Rest : DriftStep::Done);
}

TEST(DriftCheck, RefusesWhatIsNoSetting) {
    const auto refused = [](auto change) {
        auto settings = before(2);
        change(settings);
        return !DriftCheck::create(test::gridUpTo(10), settings, 1);
    };
    EXPECT_FALSE(refused([](auto&) {}));
    for (const double bad : {0.0, -1.0, std::nan("")}) {
        EXPECT_TRUE(refused([&](auto& s) { s.felt = bad; }));
        EXPECT_TRUE(refused([&](auto& s) { s.last = bad; }));
        EXPECT_TRUE(refused([&](auto& s) { s.min = bad; }));
        EXPECT_TRUE(refused([&](auto& s) { s.priorSd_db = bad; }));
        EXPECT_TRUE(refused([&](auto& s) { s.threshold = bad; }));
    }
    EXPECT_TRUE(refused([](auto& s) { s.trials = 0; }));
    auto check = DriftCheck::create(test::gridUpTo(10), before(2), 1).value();
    EXPECT_FALSE(check.rested()) << "no rest was asked for";
}

}  // namespace
}  // namespace tacto
