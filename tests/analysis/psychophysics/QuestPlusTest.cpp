#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/psychophysics/QuestPlus.h"
#include "core/base/Random.h"
#include "core/base/Statistics.h"
#include "tests/analysis/psychophysics/Procedures.h"
#include "tests/support/Figures.h"
#include "tests/support/InTime.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

QuestPlusSettings felt(double level) {
    QuestPlusSettings settings;
    settings.felt = level;
    return settings;
}

TEST(QuestPlus, AsksForTheLevelsAndKnowsThePosteriorOfAnIndependentComputation) {
    for (const auto& run : test::figuresOf("psychophysics").at("quest_plus")) {
        const double step = run.at("step").get<double>();
        const auto levels = run.at("levels").get<std::size_t>();
        const auto grid = test::gridUpTo(step * static_cast<double>(levels), step);
        ASSERT_EQ(grid.count(), levels);
        QuestPlusSettings settings;
        settings.felt = run.at("felt").get<double>();
        settings.prior = run.at("prior").get<double>();
        settings.priorSd_db = run.at("prior_sd_db").get<double>();
        settings.first = run.at("first").get<double>();
        settings.least = run.at("least").get<std::size_t>();
        settings.most = run.at("most").get<std::size_t>();
        auto quest = QuestPlus::create(grid, settings, 1).value();
        const auto asked = run.at("asked").get<std::vector<std::size_t>>();
        const auto right = run.at("right").get<std::vector<bool>>();
        for (std::size_t i = 0; i < asked.size(); ++i) {
            const auto trial = quest.next();
            ASSERT_TRUE(trial) << "trial " << i + 1;
            EXPECT_EQ(trial->number, i + 1);
            ASSERT_EQ(trial->level, grid.level(asked[i])) << "trial " << i + 1;
            ASSERT_TRUE(quest.answer(right[i] ? trial->interval : test::other(trial->interval)));
        }
        EXPECT_TRUE(quest.done());
        EXPECT_FALSE(quest.next());
        // The prior of α in cells of 0.5 dB. The first cell is 12 dB below the level that was felt.
        const auto expected = run.at("posterior").get<std::vector<double>>();
        ASSERT_EQ(expected.size(), 43U);
        const auto aboveCell = [&](std::size_t i) {
            return quest.probabilityAbove(settings.felt * std::pow(10, (0.5 * static_cast<double>(i) - 12.25) / 20));
        };
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_NEAR(aboveCell(i) - aboveCell(i + 1), expected[i], 1e-10) << i;
        const auto result = quest.result();
        EXPECT_NEAR(result.estimate.value, run.at("estimate").get<double>(), 1e-9);
        EXPECT_NEAR(result.estimate.low, run.at("low").get<double>(), 1e-8);
        EXPECT_NEAR(result.estimate.high, run.at("high").get<double>(), 1e-8);
        EXPECT_NEAR(result.sd_db, run.at("sd_db").get<double>(), 1e-8);
        EXPECT_NEAR(result.slope, run.at("slope").get<double>(), 1e-9);
        EXPECT_NEAR(quest.probabilityAbove(0.9 * result.estimate.value), run.at("above").get<double>(), 1e-9);
        EXPECT_EQ(result.trials.size(), asked.size());
    }
}

TEST(QuestPlus, ModelsEightyPercentRightAtTheThreshold) {
    EXPECT_NEAR(QuestPlus::probabilityRight(12, 12, 8), 0.5 + 0.48 * (1 - std::exp(-1)), 1e-12);
    EXPECT_NEAR(QuestPlus::probabilityRight(-200, 12, 2), 0.5, 1e-9);
    EXPECT_NEAR(QuestPlus::probabilityRight(60, 12, 2), 0.98, 1e-12);
}

TEST(QuestPlus, NeverAsksFourTimesTheSameAndEndsAsItMust) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const auto who = drawParticipant({}, 11, seed, Micros(200));
        const auto observer = test::observerFor(who, seed);
        auto quest = QuestPlus::create(test::gridUpTo(15), felt(who.detection.value() * 1.1), seed).value();
        test::answerAll(quest, observer);
        const auto result = quest.result();
        EXPECT_GE(result.trials.size(), 24U);
        EXPECT_LE(result.trials.size(), 40U);
        EXPECT_TRUE(result.trials.size() == 40 || result.sd_db <= 0.8);
        for (std::size_t i = 3; i < result.trials.size(); ++i) {
            bool same = true;
            for (std::size_t k = i - 3; k < i; ++k) same = same && result.trials[k].level == result.trials[i].level;
            EXPECT_FALSE(same) << "seed " << seed << ", trial " << i + 1;
        }
        EXPECT_FALSE(quest.answer(TrialInterval::First));
    }
}

TEST(QuestPlus, PresentsInEitherIntervalFiveTimesInTen) {
    std::size_t alike = 0, changed = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const TwoIntervalOrder order(seed, "detection"), again(seed, "detection"), drift(seed, "drift");
        for (std::size_t ten = 0; ten < 4; ++ten) {
            std::size_t first = 0;
            for (std::size_t i = 1; i <= 10; ++i) {
                const auto interval = order.of(10 * ten + i);
                EXPECT_EQ(interval, again.of(10 * ten + i));
                if (interval == TrialInterval::First) ++first;
                if (interval == drift.of(10 * ten + i)) ++alike;
                if (ten > 0 && interval != order.of(i)) ++changed;
            }
            EXPECT_EQ(first, 5U);
        }
    }
    EXPECT_NEAR(static_cast<double>(alike) / 8000, 0.5, 0.05) << "another procedure has another order";
    EXPECT_NEAR(static_cast<double>(changed) / 6000, 0.5, 0.05) << "no ten repeats the one before";
}

TEST(QuestPlus, CountsTheRightAnswersOfEachInterval) {
    auto quest = QuestPlus::create(test::gridUpTo(15), felt(4), 1).value();
    while (quest.next()) ASSERT_TRUE(quest.answer(TrialInterval::First));  // this person always says "first"
    const auto shares = quest.result().intervals;
    EXPECT_EQ(shares.first.right, shares.first.trials);
    EXPECT_EQ(shares.second.right, 0U);
    EXPECT_EQ(shares.first.trials + shares.second.trials, quest.result().trials.size());
}

TEST(QuestPlus, SaysWhenTheThresholdLiesAtTheEndOfWhatItConsidered) {
    for (const bool right : {false, true}) {
        auto quest = QuestPlus::create(test::gridUpTo(60), felt(4), 1).value();
        EXPECT_FALSE(quest.result().atEdge);
        while (const auto trial = quest.next()) {
            ASSERT_TRUE(quest.answer(right ? trial->interval : test::other(trial->interval)));
        }
        EXPECT_TRUE(quest.result().atEdge);
    }
    auto quest = QuestPlus::create(test::gridUpTo(15), felt(4), 1).value();
    test::answerAll(quest, test::observerFor(test::medianParticipant(), 1));
    EXPECT_FALSE(quest.result().atEdge);
}

struct Recovery {
    std::size_t people = 0;
    double bias = 0;
    double sd = 0;
    double cover = 0;
    double trials = 0;
};

/// Runs participants of the whole population through the ascending limits, as in a session, within the device's range.
/// `other`: factor between their thresholds and the thresholds used for comparison.
Recovery recoveryOf(std::size_t people, double step, double other = 1) {
    Recovery out;
    double sum = 0, squares = 0;
    for (std::size_t i = 0; out.people < people; ++i) {
        const auto who = drawParticipant({}, 2024, i, Micros(200));
        auto feels = who;
        feels.detection *= other;
        const auto observer = test::observerFor(feels, i);
        const auto grid = test::gridUpTo(15, step);
        const auto limits = test::ascend(grid, observer, i);
        if (std::isnan(limits.felt)) continue;
        auto quest = QuestPlus::create(grid, felt(limits.felt), i).value();
        test::answerAll(quest, observer);
        const auto result = quest.result();
        const double ratio = result.estimate.value / who.detection.value();
        ++out.people;
        sum += ratio - 1;
        squares += (ratio - 1) * (ratio - 1);
        const bool covered =
            result.estimate.low <= who.detection.value() && who.detection.value() <= result.estimate.high;
        out.cover += covered ? 1 : 0;
        out.trials += static_cast<double>(result.trials.size());
    }
    const auto n = static_cast<double>(out.people);
    out.bias = sum / n;
    out.sd = std::sqrt(squares / n - out.bias * out.bias);
    out.cover /= n;
    out.trials /= n;
    return out;
}

TEST(QuestPlus, RecoversTheThresholdsOfVirtualParticipants) {
    const auto people = test::trials<std::size_t>({.local = 500, .ci = 2000, .campaign = 20'000});
    const auto found = recoveryOf(people, 0.5);
    std::printf("bias %.4f, sd %.4f, cover %.4f, %.1f trials\n", found.bias, found.sd, found.cover, found.trials);
    EXPECT_LE(std::abs(found.bias), 0.03);
    EXPECT_LE(found.sd, 0.12);
    EXPECT_GE(found.cover, 0.93);
}

TEST(QuestPlus, ARecoveryThatIsWrongIsFound) {
    EXPECT_GT(recoveryOf(200, 0.5, 1.05).bias, 0.03) << "an estimate that is 5 % too high";
    EXPECT_LT(recoveryOf(200, 0.5, 0.95).bias, -0.03);
    EXPECT_LT(recoveryOf(200, 0.5, 1.25).cover, 0.93) << "an interval that misses the threshold";
}

TEST(QuestPlus, TakesFarLessThanATrialLasts) {
    const auto begun = std::chrono::steady_clock::now();
    constexpr int kRuns = 20;
    for (int run = 0; run < kRuns; ++run) {
        auto settings = felt(4);
        settings.least = 40;
        auto quest = QuestPlus::create(test::gridUpTo(15), settings, static_cast<std::uint64_t>(run)).value();
        test::answerAll(quest, test::observerFor(test::medianParticipant(), 1));
    }
    const Seconds each = (std::chrono::steady_clock::now() - begun) / kRuns;
    std::printf("a run of 40 trials: %.2f ms\n", 1e3 * each.count());
    EXPECT_IN_TIME(each < Seconds(0.2));
}

TEST(QuestPlus, RefusesWhatIsNoSetting) {
    const auto grid = test::gridUpTo(15);
    const auto refused = [&](auto change) {
        auto settings = felt(4);
        change(settings);
        return !QuestPlus::create(grid, settings, 1);
    };
    const double nan = std::nan("");
    EXPECT_FALSE(refused([](auto&) {}));
    for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
        EXPECT_TRUE(refused([&](auto& s) { s.felt = bad; })) << bad;
        EXPECT_TRUE(refused([&](auto& s) { s.priorSd_db = bad; })) << bad;
    }
    EXPECT_TRUE(refused([&](auto& s) { s.prior = nan; }));
    EXPECT_TRUE(refused([&](auto& s) { s.first = -1; }));
    EXPECT_TRUE(refused([&](auto& s) { s.enough_db = nan; }));
    EXPECT_TRUE(refused([](auto& s) { s.least = 0; }));
    EXPECT_TRUE(refused([](auto& s) { s.most = 10; }));
    auto quest = QuestPlus::create(grid, felt(4), 1).value();
    EXPECT_FALSE(quest.answer(static_cast<TrialInterval>(5)));
    EXPECT_EQ(quest.next()->number, 1U);
    EXPECT_FALSE(trialIntervalFrom("third"));
    EXPECT_EQ(trialIntervalFrom("second").value(), TrialInterval::Second);
}

DriftCheckSettings before(std::size_t block) { return {.felt = 3.5, .last = 3.1, .min = 4, .block = block}; }

/// Takes every rest that is asked for. After it, thresholds are `afterRest` times the median participant's.
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
    EXPECT_GE(adapted, 75);  // 0.83 by a separate computation: four checks in a row of 12 trials each
}

TEST(DriftCheck, GoesOnWhenTheRestHelped) {
    int recovered = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto result = checked(1.8, 1, seed);
        if (result.rests > 0 && !result.adapted) ++recovered;
    }
    EXPECT_GE(recovered, 75);
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

/// Posterior over (α, β) written from the definition, α in steps of a tenth of the cell, all in plain sums.
TEST(QuestPlus, TheCourseAndTheFunctionAreThoseOfSumsOverAllModels) {
    RecordProperty("hazard", "H9");
    Random random(49, "detection course");
    const int rounds = test::trials<int>({.local = 12, .ci = 60, .campaign = 600});
    for (int round = 0; round < rounds; ++round) {
        const double first = 0.3 + 8 * random.uniform();
        std::vector<LevelAnswer> answers;
        for (std::size_t i = 0, n = 1 + random.below(40); i < n; ++i)
            answers.push_back({first * (0.3 + 2 * random.uniform()), random.uniform() < 0.8});
        const std::vector<double> at = {first * 0.4, first, first * 1.7};
        const auto found = detectionCourse(answers, first, at).value();
        ASSERT_EQ(found.threshold.size(), answers.size());
        const double f_db = 20 * std::log10(first);
        const auto right = [](double level, double alpha, double beta) {
            return 0.5 + 0.48 * (1 - std::exp(-std::pow(10, beta * (20 * std::log10(level) - alpha) / 20)));
        };
        for (const std::size_t upTo : {std::size_t{1}, answers.size()}) {
            double total = 0, meanAlpha = 0;
            double share[3] = {0, 0, 0}, below[3] = {0, 0, 0}, above[3] = {0, 0, 0}, belowAlpha = 0, aboveAlpha = 0;
            const auto& threshold = found.threshold[upTo - 1];
            for (int cell = 0; cell < 43; ++cell) {
                const double alpha = f_db - 12 + 0.5 * cell;
                for (const double beta : {2.0, 4.0, 8.0, 16.0}) {
                    double weight = std::exp(-std::pow((alpha - (f_db - 1)) / 4, 2) / 2);
                    for (std::size_t i = 0; i < upTo; ++i) {
                        const double p = right(answers[i].level, alpha, beta);
                        weight *= answers[i].correct ? p : 1 - p;
                    }
                    total += weight;
                    meanAlpha += weight * alpha;
                    for (int part = 0; part < 100; ++part) {
                        const double inside = alpha + 0.5 * ((part + 0.5) / 100 - 0.5), some = weight / 100;
                        belowAlpha += inside < 20 * std::log10(threshold.low) ? some : 0;
                        aboveAlpha += inside > 20 * std::log10(threshold.high) ? some : 0;
                        if (upTo != answers.size()) continue;
                        for (std::size_t k = 0; k < at.size(); ++k) {
                            const double p = right(at[k], inside, beta);
                            share[k] += some * p;
                            below[k] += p < found.right[k].low ? some : 0;
                            above[k] += p > found.right[k].high ? some : 0;
                        }
                    }
                }
            }
            EXPECT_NEAR(threshold.value, std::pow(10, meanAlpha / total / 20), 1e-9 * threshold.value);
            EXPECT_NEAR(belowAlpha / total, 0.025, 0.006);
            EXPECT_NEAR(aboveAlpha / total, 0.025, 0.006);
            if (upTo != answers.size()) continue;
            for (std::size_t k = 0; k < at.size(); ++k) {
                EXPECT_NEAR(found.right[k].value, share[k] / total, 1e-3);
                EXPECT_LE(below[k] / total, 0.03);
                EXPECT_LE(above[k] / total, 0.03);
            }
        }
    }
    EXPECT_FALSE(detectionCourse({}, 0, {}));
    EXPECT_FALSE(detectionCourse(std::vector<LevelAnswer>{{kNaN, true}}, 1, {}));
    EXPECT_FALSE(detectionCourse(std::vector<LevelAnswer>{{1, true}}, 1, std::vector<double>{-1}));
}

}  // namespace
}  // namespace tacto
