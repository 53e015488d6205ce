#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "core/analysis/drift/Drift.h"
#include "tests/analysis/SyntheticTrials.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

using testing::HasSubstr;

/// Makes `repeats` trials of each condition, in a new order for every repeat, with relative `scatter`. `change`
/// multiplies the amplitude, given the position in the session from 0 to 1.
template <class Change>
std::vector<SeparabilityTrial> session(std::mt19937& random, int repeats, double scatter, Change&& change) {
    std::normal_distribution<double> noise(0, 1);
    std::vector<SeparabilityTrial> trials;
    const int all = 4 * repeats;
    for (int i = 0; i < repeats; ++i) {
        std::vector<int> order{0, 1, 2, 3};
        std::shuffle(order.begin(), order.end(), random);
        for (const int c : order) {
            const double place = double(trials.size()) / double(all - 1);
            const double level = c < 2 ? 10 : 40;
            trials.push_back({test::kFourConditions[std::size_t(c)],
                              level * change(place) * std::exp(scatter * noise(random)), c % 2 == 0 ? 2.0 : 0.5, 0, 0});
        }
    }
    return trials;
}

TEST(Drift, ALineWithoutScatterIsFoundAsItIs) {
    std::mt19937 random(1);
    for (const double percent : {-40.0, -3.0, 0.0, 0.7, 12.0}) {
        const auto trials = session(random, 25, 0, [&](double place) { return std::pow(1 + percent / 100, place); });
        const auto found = judgeDrift(trials);
        ASSERT_TRUE(found) << found.error().message;
        EXPECT_NEAR(found->change_pct.value, percent, 1e-9);
        for (const auto& condition : found->conditions) EXPECT_NEAR(condition.change_pct.value, percent, 1e-9);
        EXPECT_EQ(nameOf(found->verdict), std::abs(percent) > 5 ? "fail" : "pass") << percent;
    }
}

TEST(Drift, ItsIntervalsHoldTheTruthAsOftenAsTheySay) {
    const int seeds = test::trials<int>({.local = 400, .ci = 2000, .campaign = 20000});
    int line = 0, quarters = 0, condition = 0;
    for (int seed = 0; seed < seeds; ++seed) {
        std::mt19937 random{unsigned(seed)};
        const double truth = std::uniform_real_distribution<double>(-6, 6)(random);
        const auto trials = session(random, 12, 0.02, [&](double place) { return std::pow(1 + truth / 100, place); });
        const auto found = judgeDrift(trials);
        ASSERT_TRUE(found);
        const auto holds = [](const Estimate& each, double value) { return each.low <= value && value <= each.high; };
        line += holds(found->change_pct, truth);
        condition += holds(found->conditions[2].change_pct, truth);
        const auto still = judgeDrift(session(random, 12, 0.02, [](double) { return 1.0; }));
        ASSERT_TRUE(still);
        quarters += holds(still->betweenQuarters_pct, 0);
    }
    // Three standard deviations of a count at 95 %.
    const double share = 0.95, spread = 3 * std::sqrt(share * (1 - share) / seeds);
    EXPECT_NEAR(double(line) / seeds, share, spread);
    EXPECT_NEAR(double(condition) / seeds, share, spread);
    EXPECT_GT(double(quarters) / seeds, share - spread);  // the Bonferroni correction guarantees at least this
}

TEST(Drift, AWarmUpOrAStepThatALineHidesFailsByItsQuarters) {
    std::mt19937 random(3);
    const auto warmUp = session(random, 25, 0.003, [](double place) { return 1 - 0.2 * std::exp(-12 * place); });
    const auto step = session(random, 25, 0.003, [](double place) { return place > 0.3 && place < 0.7 ? 1.12 : 1.0; });
    for (const auto& trials : {warmUp, step}) {
        const auto found = judgeDrift(trials);
        ASSERT_TRUE(found);
        EXPECT_EQ(nameOf(found->verdict), "fail");
        EXPECT_THAT(found->reasons, testing::Contains(HasSubstr("Between two quarters")));
    }
}

TEST(Drift, StrongConditionsFirstAndWeakOnesLastAreNone) {
    std::mt19937 random(4);
    auto trials = session(random, 25, 0.004, [](double) { return 1.0; });
    // Ten more strong trials at the beginning, and ten more weak ones at the end.
    std::vector<SeparabilityTrial> more(10, {"rough-low", 40, 2, 0, 0});
    trials.insert(trials.begin(), more.begin(), more.end());
    trials.insert(trials.end(), 10, {"smooth-low", 10, 2, 0, 0});
    const auto found = judgeDrift(trials);
    ASSERT_TRUE(found);
    EXPECT_EQ(nameOf(found->verdict), "pass") << found->reasons.front();
    EXPECT_LT(std::abs(found->change_pct.value), 1);
}

TEST(Drift, WhatIsNotKnownIsNoPassH9) {
    std::mt19937 random(5);
    const auto steady = session(random, 25, 0.002, [](double) { return 1.0; });
    ASSERT_EQ(nameOf(judgeDrift(steady)->verdict), "pass");
    auto missing = steady;
    missing[17].amplitude = std::nan("");
    EXPECT_EQ(nameOf(judgeDrift(missing)->verdict), "indeterminate");
    EXPECT_THAT(judgeDrift(missing)->reasons, testing::ElementsAre("1 of 100 trials were not measured."));
    auto unknown = steady;
    unknown[99].amplitudeUncertainty = std::nan("");
    EXPECT_EQ(nameOf(judgeDrift(unknown)->verdict), "indeterminate");
    auto none = steady;
    for (auto& trial : none) trial.amplitude = std::nan("");
    EXPECT_EQ(nameOf(judgeDrift(none)->verdict), "indeterminate");
    for (std::size_t n = 1; n < 8; ++n)
        EXPECT_EQ(nameOf(judgeDrift(std::span(steady).first(n))->verdict), "indeterminate") << n;
    // None of the last quarter was measured, so there is no verdict.
    auto half = steady;
    for (std::size_t i = 75; i < 100; ++i) half[i].amplitude = std::nan("");
    EXPECT_EQ(nameOf(judgeDrift(half)->verdict), "indeterminate");
}

TEST(Drift, AnInstrumentThatResolvesLittleShowsLittle) {
    std::mt19937 random(6);
    auto coarse = session(random, 3, 0.0001, [](double) { return 1.0; });
    for (auto& trial : coarse) trial.amplitudeUncertainty = 0.05 * trial.amplitude;
    EXPECT_EQ(nameOf(judgeDrift(coarse)->verdict), "indeterminate");
    // All the uncertainty is in the channel's gain, which every trial shares.
    for (auto& trial : coarse) trial.amplitudeGain = 0.05;
    EXPECT_EQ(nameOf(judgeDrift(coarse)->verdict), "pass");
}

TEST(Drift, RefusesWhatIsNoAmplitudeAndNoTolerance) {
    std::mt19937 random(7);
    const auto steady = session(random, 5, 0.01, [](double) { return 1.0; });
    EXPECT_FALSE(judgeDrift({}));
    for (const double wrong : {0.0, -1.0, double(INFINITY)}) {
        auto trials = steady;
        trials[3].amplitude = wrong;
        const auto found = judgeDrift(trials);
        ASSERT_FALSE(found) << wrong;
        EXPECT_THAT(found.error().message, HasSubstr("trial 4"));
    }
    auto nameless = steady;
    nameless[0].condition.clear();
    EXPECT_FALSE(judgeDrift(nameless));
    for (const double wrong : {0.0, -5.0, 101.0, double(NAN), double(INFINITY)})
        EXPECT_FALSE(judgeDrift(steady, {.tolerance_pct = wrong})) << wrong;
}

TEST(Drift, ManyConditionsOfOneTrialTakeNoTime) {
    std::vector<SeparabilityTrial> trials;
    for (int i = 0; i < 3000; ++i) trials.push_back({fmt::format("condition {}", i), 10.0 + i, 1, 0, 0});
    const auto found = judgeDrift(trials);
    ASSERT_TRUE(found);
    EXPECT_EQ(nameOf(found->verdict), "indeterminate");
}

}  // namespace
}  // namespace tacto
