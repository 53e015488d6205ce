#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <string>

#include "core/analysis/psychophysics/TrialPlan.h"
#include "core/analysis/statistics/ConfidenceBound.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

std::vector<PlannedTrial> of(const std::vector<PlannedTrial>& plan, TrialPhase phase) {
    std::vector<PlannedTrial> out;
    std::ranges::copy_if(plan, std::back_inserter(out), [&](const auto& trial) { return trial.phase == phase; });
    return out;
}

/// Writes trials as text, "0123x": one character per trial, x for a catch trial.
std::string written(const std::vector<PlannedTrial>& trials) {
    std::string out;
    for (const auto& trial : trials) out += trial.condition ? static_cast<char>('0' + *trial.condition) : 'x';
    return out;
}

bool hasRunOfFour(const std::string& order) {
    for (std::size_t i = 3; i < order.size(); ++i) {
        if (order[i] != 'x' && order.substr(i - 3, 4) == std::string(4, order[i])) return true;
    }
    return false;
}

TEST(TrialPlan, ObeysItsRulesWhateverTheSeed) {
    const auto seeds = test::trials<std::uint64_t>({.local = 500, .ci = 5000, .campaign = 50'000});
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const auto plan = planTrials({}, seed).value();
        ASSERT_EQ(plan.size(), 3U * 5 + 4 * 8 + 5 * 18);
        for (std::size_t i = 0; i < plan.size(); ++i) ASSERT_EQ(plan[i].number, i + 1);
        EXPECT_EQ(written(of(plan, TrialPhase::Familiarisation)), "0123x0123x0123x");
        const auto training = written(of(plan, TrialPhase::Training)), tested = written(of(plan, TrialPhase::Test));
        EXPECT_FALSE(hasRunOfFour(training)) << training;
        EXPECT_FALSE(hasRunOfFour(tested)) << tested;
        EXPECT_EQ(tested.find("xx"), std::string::npos) << tested;
        EXPECT_EQ(training.find('x'), std::string::npos);
        for (std::size_t block = 0; block < 5; ++block) {
            const auto part = tested.substr(18 * block, 18);
            EXPECT_NE(part[0], 'x') << tested;
            EXPECT_EQ(std::ranges::count(part, 'x'), 2);
            for (const char condition : {'0', '1', '2', '3'}) EXPECT_EQ(std::ranges::count(part, condition), 4);
        }
        for (std::size_t block = 0; block < 4; ++block) {
            for (const char condition : {'0', '1', '2', '3'}) {
                EXPECT_EQ(std::ranges::count(training.substr(8 * block, 8), condition), 2);
            }
        }
        for (std::size_t i = 0; i < 90; ++i) EXPECT_EQ(plan[15 + 32 + i].block, 1 + i / 18);
    }
}

/// Compares by χ² the orders drawn with a uniform share of all valid orders, found by enumeration.
void expectUniform(const TrialPlanSettings& settings, std::size_t orders, const std::string& sortedBlock) {
    std::map<std::string, std::size_t> found;
    std::vector<std::string> blocks, all = {""};
    auto block = sortedBlock;
    do {
        if (block[0] != 'x' && block.find("xx") == std::string::npos && !hasRunOfFour(block)) blocks.push_back(block);
    } while (std::next_permutation(block.begin(), block.end()));
    for (std::size_t i = 0; i < settings.blocks; ++i) {
        std::vector<std::string> longer;
        for (const auto& one : all)
            for (const auto& next : blocks) longer.push_back(one + next);
        all = longer;
    }
    for (const auto& order : all)
        if (!hasRunOfFour(order)) found[order] = 0;
    ASSERT_EQ(found.size(), orders);
    const std::size_t seeds = 300 * orders;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const auto order = written(of(planTrials(settings, seed).value(), TrialPhase::Test));
        ASSERT_TRUE(found.contains(order)) << order;
        ++found[order];
    }
    double chi = 0;
    for (const auto& [order, n] : found) chi += (static_cast<double>(n) - 300) * (static_cast<double>(n) - 300) / 300;
    EXPECT_LT(chi, chiSquaredQuantile(0.999, static_cast<double>(orders - 1)));
    EXPECT_GT(chi, chiSquaredQuantile(0.001, static_cast<double>(orders - 1)));
}

TrialPlanSettings small(std::size_t blocks, std::size_t perCondition, std::size_t catchTrials) {
    TrialPlanSettings out;
    out.conditions = 2;
    out.familiarisationRounds = out.trainingBlocks = 0;
    out.blocks = blocks;
    out.perCondition = perCondition;
    out.catchTrials = catchTrials;
    return out;
}

TEST(TrialPlan, IsUniformAmongTheOrdersThatObey) {
    expectUniform(small(1, 2, 2), 36, "0011xx");
    // 6 · 6 orders of two blocks, less the two that form a run of four where the blocks meet.
    expectUniform(small(2, 2, 0), 34, "0011");
    // 70 orders of 8, less those with a run of four: 5 for each condition, of which 2 are counted twice.
    expectUniform(small(1, 4, 0), 62, "00001111");
}

TEST(TrialPlan, ComesFromTheSeed) {
    EXPECT_EQ(planTrials({}, 5).value(), planTrials({}, 5).value());
    EXPECT_NE(planTrials({}, 5).value(), planTrials({}, 6).value());
    // The number of blocks does not affect the training.
    TrialPlanSettings more;
    more.blocks = 7;
    EXPECT_EQ(written(of(planTrials({}, 5).value(), TrialPhase::Training)),
              written(of(planTrials(more, 5).value(), TrialPhase::Training)));
}

TEST(TrialPlan, RefusesWhatHasNoOrder) {
    const auto refused = [](auto change) {
        TrialPlanSettings settings;
        change(settings);
        return !planTrials(settings, 1);
    };
    EXPECT_TRUE(refused([](auto& s) { s.conditions = 1; }));
    EXPECT_TRUE(refused([](auto& s) { s.blocks = 0; }));
    EXPECT_TRUE(refused([](auto& s) { s.perCondition = 0; }));
    EXPECT_TRUE(refused([](auto& s) { s.catchTrials = 21; }));
    EXPECT_TRUE(refused([](auto& s) { s.catchTrials = 17; })) << "more than trials to stand between";
    EXPECT_FALSE(refused([](auto& s) { s.trainingBlocks = s.familiarisationRounds = s.catchTrials = 0; }));
}

TEST(TrainingRule, EndsAfterSevenOfEightOrFourBlocks) {
    auto quick = TrainingRule::create({}).value();
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(quick.next()->block, 1U);
        EXPECT_EQ(quick.next()->trial, static_cast<std::size_t>(i + 1));
        ASSERT_TRUE(quick.answer(i != 3));
    }
    EXPECT_TRUE(quick.done());
    EXPECT_TRUE(quick.result().reached);
    EXPECT_EQ(quick.result().right, (std::vector<std::size_t>{7}));
    EXPECT_FALSE(quick.next());
    EXPECT_FALSE(quick.answer(true));

    auto slow = TrainingRule::create({}).value();
    for (int i = 0; i < 32; ++i) ASSERT_TRUE(slow.answer(i % 8 < 6));
    EXPECT_TRUE(slow.done());
    EXPECT_FALSE(slow.result().reached);
    EXPECT_EQ(slow.result().right, (std::vector<std::size_t>{6, 6, 6, 6}));
}

TEST(TrainingRule, RefusesWhatIsNoSetting) {
    EXPECT_FALSE(TrainingRule::create({.blockSize = 0}));
    EXPECT_FALSE(TrainingRule::create({.share = 0}));
    EXPECT_FALSE(TrainingRule::create({.share = std::nan("")}));
    EXPECT_TRUE(TrainingRule::create({.most = 0}).value().done());
}

}  // namespace
}  // namespace tacto
