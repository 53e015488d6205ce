#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/psychophysics/QuestPlus.h"
#include "core/analysis/psychophysics/Staircase.h"
#include "core/base/Random.h"
#include "tests/analysis/psychophysics/Procedures.h"
#include "tests/support/Figures.h"

namespace tacto {
namespace {

TEST(Staircase, GoesWhereAnIndependentComputationGoes) {
    for (const auto& run : test::figuresOf("psychophysics").at("staircase")) {
        const double step = run.at("step").get<double>();
        const auto grid = test::gridUpTo(step * run.at("levels").get<double>(), step);
        auto staircase = Staircase::create(grid, {.felt = run.at("felt").get<double>()}, 1).value();
        const auto asked = run.at("asked").get<std::vector<std::size_t>>();
        const auto right = run.at("right").get<std::vector<bool>>();
        for (std::size_t i = 0; i < asked.size(); ++i) {
            const auto trial = staircase.next();
            ASSERT_TRUE(trial);
            ASSERT_EQ(trial->level, grid.level(asked[i])) << "trial " << i + 1;
            ASSERT_TRUE(staircase.answer(right[i] ? trial->interval : test::other(trial->interval)));
        }
        EXPECT_TRUE(staircase.done());
        const auto result = staircase.result();
        const auto reversals = run.at("reversals").get<std::vector<std::size_t>>();
        ASSERT_EQ(result.reversals.size(), reversals.size());
        for (std::size_t i = 0; i < reversals.size(); ++i) EXPECT_EQ(result.reversals[i], grid.level(reversals[i]));
        EXPECT_NEAR(result.estimate, run.at("estimate").get<double>(), 1e-9);
        EXPECT_FALSE(staircase.answer(TrialInterval::First));
    }
}

TEST(Staircase, ApproachesTheLevelWithFourOfFiveRight) {
    // Steps of 5 % of F and a shallow function: the steps are small compared with its width, as the formula requires.
    const auto grid = test::gridUpTo(20, 0.02);
    StaircaseSettings settings;
    settings.felt = 4;
    settings.reversals = settings.averaged = 6000;
    settings.most = 200'000;
    auto staircase = Staircase::create(grid, settings, 1).value();
    Random random(9, "answers");
    while (const auto trial = staircase.next()) {
        const double p = QuestPlus::probabilityRight(20 * std::log10(trial->level), 20 * std::log10(3.5), 2);
        const bool right = random.uniform() < p;
        ASSERT_TRUE(staircase.answer(right ? trial->interval : test::other(trial->interval)));
    }
    // The mean over all trials, which the formula predicts, and for comparison the mean of reversals.
    double sum = 0;
    for (const auto& trial : staircase.result().trials) sum += trial.level;
    const double mean = sum / static_cast<double>(staircase.result().trials.size());
    const auto rightAt = [](double level) {
        return QuestPlus::probabilityRight(20 * std::log10(level), 20 * std::log10(3.5), 2);
    };
    std::printf("right at the mean level %.4f, at the mean of reversals %.4f\n", rightAt(mean),
                rightAt(staircase.result().estimate));
    EXPECT_NEAR(rightAt(mean), std::sqrt(2.0 / 3), 0.015);
    EXPECT_NEAR(rightAt(staircase.result().estimate), std::sqrt(2.0 / 3), 0.02);
}

TEST(Staircase, KnowsNothingWithTooFewReversals) {
    auto staircase = Staircase::create(test::gridUpTo(15), {.felt = 4}, 1).value();
    while (const auto trial = staircase.next()) ASSERT_TRUE(staircase.answer(trial->interval));
    EXPECT_EQ(staircase.result().trials.size(), 60U);
    EXPECT_TRUE(std::isnan(staircase.result().estimate));
    EXPECT_EQ(staircase.result().trials.back().level, 0.5);
}

TEST(Staircase, RefusesWhatIsNoSetting) {
    const auto refused = [](const StaircaseSettings& settings) {
        return !Staircase::create(test::gridUpTo(15), settings, 1);
    };
    EXPECT_FALSE(refused({.felt = 4}));
    EXPECT_TRUE(refused({.felt = std::nan("")}));
    EXPECT_TRUE(refused({.felt = 0}));
    EXPECT_TRUE(refused({.felt = 4, .reversals = 1}));
    EXPECT_TRUE(refused({.felt = 4, .averaged = 9}));
    EXPECT_TRUE(refused({.felt = 4, .most = 0}));
    auto staircase = Staircase::create(test::gridUpTo(15), {.felt = 4}, 1).value();
    EXPECT_FALSE(staircase.answer(static_cast<TrialInterval>(2)));
}

}  // namespace
}  // namespace tacto
