#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <set>

#include "core/analysis/psychophysics/AscendingLimits.h"
#include "core/base/Random.h"
#include "tests/analysis/psychophysics/Procedures.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using Answers = std::function<StrengthWord(const AscendingPresentation&)>;

/// Returns answers of a person who feels from `felt` and always calls `strong` too strong.
Answers sure(double felt, double strong) {
    return [=](const AscendingPresentation& asked) {
        if (asked.level < felt) return StrengthWord::Nothing;
        return asked.level >= strong ? StrengthWord::TooStrong : StrengthWord::Weak;
    };
}

std::vector<AscendingPresentation> presented(AscendingLimits& limits, const Answers& answers) {
    std::vector<AscendingPresentation> out;
    while (const auto asked = limits.next()) {
        out.push_back(*asked);
        if (!limits.answer(answers(*asked)) || out.size() > 10'000) {
            ADD_FAILURE() << "presentation " << asked->number;
            break;
        }
    }
    return out;
}

TEST(AscendingLimits, FindsTheFirstLevelsFeltAndTheLowestTooStrong) {
    auto limits = AscendingLimits::create(test::gridUpTo(15), 1).value();
    presented(limits, sure(3.2, 8.7));
    const auto result = limits.result();
    EXPECT_EQ(result.felt, 3.5);
    EXPECT_EQ(result.tooStrong, 9);
    EXPECT_TRUE(result.saidTooStrong);
    ASSERT_EQ(result.series.size(), 3U);
    EXPECT_EQ(result.series[0].endedBy, SeriesEnd::TooStrong);
    EXPECT_EQ(result.series[0].tooStrong, 9);
    // A level that was too strong is not presented again.
    for (const std::size_t series : {1U, 2U}) {
        EXPECT_EQ(result.series[series].endedBy, SeriesEnd::Ceiling);
        EXPECT_EQ(result.series[series].ceiling, LevelLimit::TooStrong);
        EXPECT_EQ(result.series[series].highest, 8.5);
    }
    EXPECT_FALSE(limits.answer(StrengthWord::Nothing));
}

TEST(AscendingLimits, StartsEachSeriesFromNothingAndNeverRisesByMoreThanItMay) {
    RecordProperty("hazard", "H6");
    for (const double step : {0.5, 0.1, 0.01, 1.0}) {
        for (std::uint64_t seed = 0; seed < 30; ++seed) {
            auto limits = AscendingLimits::create(test::gridUpTo(60, step), seed).value();
            double last = 0;
            std::size_t series = 0, leading = 0, answered = 0;
            for (const auto& asked : presented(limits, sure(3, 58.3))) {
                EXPECT_EQ(asked.number, ++answered);
                if (asked.series != series) {
                    series = asked.series;
                    last = 0;
                    leading = 0;
                    EXPECT_TRUE(asked.empty());
                }
                if (asked.empty()) {
                    leading += last == 0 ? 1 : 0;
                    continue;
                }
                if (last == 0) {
                    // 1 to 3 at the beginning, and one more if the first of the next five is empty.
                    EXPECT_GE(leading, 1U);
                    EXPECT_LE(leading, 4U);
                }
                EXPECT_GT(asked.level, last);
                EXPECT_LE(asked.level - last, std::max(step, std::min(0.05 * last, 1.0)) + 1e-9);
                EXPECT_GE(asked.level - last, step * (1 - 1e-9));
                EXPECT_LE(asked.level, 58.3 + 1);
                last = asked.level;
            }
            EXPECT_EQ(series, 3U);
        }
    }
}

TEST(AscendingLimits, PresentsNothingOnceInEveryFive) {
    std::set<std::size_t> places, leads;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        auto limits = AscendingLimits::create(test::gridUpTo(15), seed).value();
        std::vector<bool> empty;
        for (const auto& asked : presented(limits, sure(3, 99))) {
            if (asked.series == 1) empty.push_back(asked.empty());
        }
        // After some number of leading ones, every complete five must contain exactly one.
        bool fits = false;
        for (std::size_t lead = 1; lead <= 3; ++lead) {
            bool each = std::all_of(empty.begin(), empty.begin() + static_cast<std::ptrdiff_t>(lead),
                                    [](bool one) { return one; });
            for (std::size_t at = lead; at + 5 <= empty.size(); at += 5) {
                const auto from = empty.begin() + static_cast<std::ptrdiff_t>(at);
                each = each && std::count(from, from + 5, true) == 1;
                if (each) places.insert(static_cast<std::size_t>(std::find(from, from + 5, true) - from));
            }
            if (each) leads.insert(lead);
            fits = fits || each;
        }
        EXPECT_TRUE(fits) << "seed " << seed;
    }
    EXPECT_EQ(places.size(), 5U);
    EXPECT_EQ(leads.size(), 3U);
}

TEST(AscendingLimits, AFeltEmptyPresentationRepeatsTheLastLevelAndReplacesItsAnswer) {
    const auto grid = test::gridUpTo(15);
    // Until an empty presentation is reported as felt, the answers do not affect the next presentation.
    auto rehearsal = AscendingLimits::create(grid, 3).value();
    const auto order = presented(rehearsal, [](const auto&) { return StrengthWord::Nothing; });
    std::size_t empty = 1;
    while (order[empty - 1].empty() || !order[empty].empty()) ++empty;  // the first empty one after a level
    const double before = order[empty - 1].level;

    auto limits = AscendingLimits::create(grid, 3).value();
    const auto first = [&] { return limits.result().series[0]; };
    for (std::size_t i = 0; i < empty; ++i) {
        ASSERT_TRUE(limits.answer(order[i].level == before ? StrengthWord::Weak : StrengthWord::Nothing));
    }
    EXPECT_EQ(first().felt, before);
    ASSERT_TRUE(limits.next()->empty());
    ASSERT_TRUE(limits.answer(StrengthWord::Weak));
    while (limits.next()->empty()) ASSERT_TRUE(limits.answer(StrengthWord::Nothing));
    EXPECT_EQ(limits.next()->level, before) << "once more";
    ASSERT_TRUE(limits.answer(StrengthWord::Nothing));
    EXPECT_TRUE(std::isnan(first().felt)) << "not felt this time";
    presented(limits, sure(6, 99));
    EXPECT_EQ(first().felt, 6);
    EXPECT_EQ(first().feltEmpty, 1U);
    EXPECT_FALSE(first().marked());
}

TEST(AscendingLimits, ASecondFeltEmptyPresentationMarksTheSeriesWhichStillEnds) {
    auto limits = AscendingLimits::create(test::gridUpTo(15), 4).value();
    const auto all = presented(limits, [](const auto&) { return StrengthWord::Weak; });
    EXPECT_LT(all.size(), 300U);
    for (const auto& series : limits.result().series) {
        EXPECT_TRUE(series.marked());
        EXPECT_EQ(series.endedBy, SeriesEnd::Ceiling);
    }
}

TEST(AscendingLimits, TooStrongEndsTheSeriesWhateverWasPresented) {
    RecordProperty("hazard", "H6");
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        auto limits = AscendingLimits::create(test::gridUpTo(15), seed).value();
        double last = 0;
        while (const auto asked = limits.next()) {
            if (asked->empty() && last >= 4) break;
            if (!asked->empty()) last = asked->level;
            ASSERT_TRUE(limits.answer(asked->empty() ? StrengthWord::Nothing : StrengthWord::Strong));
        }
        ASSERT_TRUE(limits.answer(StrengthWord::TooStrong));
        const auto result = limits.result();
        EXPECT_EQ(result.series.size(), 2U);
        EXPECT_TRUE(result.series[0].marked());
        EXPECT_EQ(result.series[0].endedBy, SeriesEnd::TooStrong);
        EXPECT_EQ(result.tooStrong, last);
        for (const auto& asked : presented(limits, sure(3, 99))) EXPECT_LT(asked.level, last);
    }
}

TEST(AscendingLimits, NamesTheCeilingThatEndsASeries) {
    const std::vector<LevelCeiling> ceilings = {{15, LevelLimit::Cap}, {6.2, LevelLimit::Gate}};
    const auto grid = LevelGrid::create(LevelUnit::Current, 0.5, ceilings).value();
    auto limits = AscendingLimits::create(grid, 1).value();
    presented(limits, sure(3.2, 99));
    const auto result = limits.result();
    EXPECT_FALSE(result.saidTooStrong);
    EXPECT_EQ(result.tooStrong, 6) << "the highest level that was answered";
    for (const auto& series : result.series) {
        EXPECT_EQ(series.endedBy, SeriesEnd::Ceiling);
        EXPECT_EQ(series.ceiling, LevelLimit::Gate);
        EXPECT_TRUE(std::isnan(series.tooStrong));
    }
}

TEST(AscendingLimits, AStopVoidsThePresentationAndEndsTheSeries) {
    RecordProperty("hazard", "H6");
    auto limits = AscendingLimits::create(test::gridUpTo(15), 2).value();
    while (limits.next()->level < 4) {
        ASSERT_TRUE(limits.answer(limits.next()->empty() ? StrengthWord::Nothing : StrengthWord::Weak));
    }
    limits.stop();
    ASSERT_TRUE(limits.next());
    EXPECT_EQ(limits.next()->series, 2U);
    EXPECT_TRUE(limits.next()->empty());
    auto result = limits.result();
    EXPECT_EQ(result.series[0].endedBy, SeriesEnd::Stop);
    EXPECT_EQ(result.series[0].highest, 3.5);
    EXPECT_EQ(result.tooStrong, 3.5);
    limits.stop();
    limits.stop();
    EXPECT_TRUE(limits.done());
    EXPECT_FALSE(limits.next());
    limits.stop();
    EXPECT_EQ(limits.result().series.size(), 3U);
}

TEST(AscendingLimits, ARefusedLevelIsACeilingForLaterSeries) {
    auto limits = AscendingLimits::create(test::gridUpTo(15), 2).value();
    while (limits.next()->level < 4) {
        ASSERT_TRUE(limits.answer(limits.next()->empty() ? StrengthWord::Nothing : StrengthWord::Weak));
    }
    limits.refused(LevelLimit::Gate);
    for (const auto& asked : presented(limits, sure(3, 99))) EXPECT_LT(asked.level, 4);
    for (const auto& series : limits.result().series) EXPECT_EQ(series.ceiling, LevelLimit::Gate);
}

TEST(AscendingLimits, KnowsNothingWhereNothingWasFelt) {
    auto limits = AscendingLimits::create(test::gridUpTo(3), 2).value();
    presented(limits, [](const auto&) { return StrengthWord::Nothing; });
    EXPECT_TRUE(std::isnan(limits.result().felt));
    EXPECT_EQ(limits.result().tooStrong, 3);
}

TEST(AscendingLimits, EndsWhereTheSmallestStepIsTooStrong) {
    auto limits = AscendingLimits::create(test::gridUpTo(3), 2).value();
    presented(limits, sure(0.1, 0.2));
    EXPECT_EQ(limits.result().tooStrong, 0.5);
    EXPECT_EQ(limits.result().series[2].highest, 0) << "no level is left";
}

TEST(AscendingLimits, ASlipThatIsTakenBackChangesNothing) {
    RecordProperty("hazard", "H12");
    std::size_t slips = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed, "slips");
        const double felt = 1 + 5 * random.uniform(), strong = felt + 2 + 6 * random.uniform();
        auto undisturbed = AscendingLimits::create(test::gridUpTo(15), seed).value();
        presented(undisturbed, sure(felt, strong));
        auto limits = AscendingLimits::create(test::gridUpTo(15), seed).value();
        double tolerated = 0, last = 0;
        std::size_t series = 0;
        bool feels = false;
        std::optional<double> takenBack;
        for (int n = 0; const auto asked = limits.next(); ++n) {
            ASSERT_LT(n, 2000);
            if (std::exchange(series, asked->series) != asked->series) {
                last = 0;
                feels = false;
                takenBack.reset();
            }
            const double about = asked->empty() ? last : asked->level;
            const bool doubt = (!feels || about <= tolerated / 2) && takenBack != about;
            ASSERT_EQ(limits.doubtful(), doubt) << "seed " << seed << ", presentation " << asked->number;
            const auto word = sure(felt, strong)(*asked);
            if (doubt && word != StrengthWord::TooStrong && random.uniform() < 0.2) {
                takenBack = about;
                limits.takeBack();
                ++slips;
                continue;
            }
            ASSERT_TRUE(limits.answer(word));
            if (asked->empty()) continue;
            last = asked->level;
            feels = feels || word != StrengthWord::Nothing;
            if (word != StrengthWord::TooStrong) tolerated = std::max(tolerated, asked->level);
        }
        const auto expected = undisturbed.result(), found = limits.result();
        EXPECT_EQ(found.felt, expected.felt) << seed;
        EXPECT_EQ(found.tooStrong, expected.tooStrong) << seed;
        for (std::size_t i = 0; i < AscendingLimits::kSeries; ++i)
            EXPECT_EQ(found.series[i].highest, expected.series[i].highest) << seed;
    }
    EXPECT_GT(slips, 1000U);
}

TEST(AscendingLimits, ReplaysFromTheAnswers) {
    auto first = AscendingLimits::create(test::gridUpTo(15), 77).value();
    auto second = AscendingLimits::create(test::gridUpTo(15), 77).value();
    auto different = AscendingLimits::create(test::gridUpTo(15), 78).value();
    const auto observer = test::observerFor(test::medianParticipant(), 5);
    const Answers answers = [&](const AscendingPresentation& asked) {
        return observer.strength(std::to_string(asked.number), asked.level, Seconds(0));
    };
    const auto levels = [&](AscendingLimits& limits) {
        std::vector<double> out;
        for (const auto& asked : presented(limits, answers)) out.push_back(asked.level);
        return out;
    };
    const auto one = levels(first);
    EXPECT_EQ(one, levels(second));
    EXPECT_NE(one, levels(different));
}

TEST(AscendingLimits, ServesMassagers) {
    auto limits = AscendingLimits::create(test::intensities(0.01), 1).value();
    double last = 0;
    for (const auto& asked : presented(limits, sure(0.2, 0.6))) {
        EXPECT_LE(asked.level, 0.64);
        if (asked.empty()) continue;
        if (asked.level > last) {
            EXPECT_LE(asked.level - last, std::max(0.01, 0.05 * last) + 1e-9);
        }
        last = asked.level;
    }
    EXPECT_NEAR(limits.result().felt, 0.2, 0.011);
}

TEST(AscendingLimits, RefusesUnknownWordsAndCoarseDevices) {
    EXPECT_EQ(strengthWordFrom("too-strong").value(), StrengthWord::TooStrong);
    EXPECT_FALSE(strengthWordFrom("Weak"));
    EXPECT_FALSE(strengthWordFrom(""));
    auto limits = AscendingLimits::create(test::gridUpTo(3), 2).value();
    const auto before = limits.next();
    EXPECT_FALSE(limits.answer(static_cast<StrengthWord>(7)));
    EXPECT_EQ(limits.next()->number, before->number);
    EXPECT_THAT(AscendingLimits::create(test::gridUpTo(15, 2), 1),
                test::refusedSaying(testing::StrEq(
                    "levels would rise by the device's step of 2 mA; at most 1 mA at a time is accepted")));
}

}  // namespace
}  // namespace tacto
