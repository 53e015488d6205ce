#include "core/analysis/psychophysics/TrialPlan.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/analysis/statistics/GivenFigure.h"
#include "core/base/Random.h"

namespace tacto {

namespace {

using PlannedOrder = std::vector<std::optional<std::size_t>>;
constexpr int kTries = 100'000;

struct PlannedBlocks {
    TrialPhase phase = TrialPhase::Test;
    std::size_t conditions = 4;
    std::size_t blocks = 1;
    std::size_t perCondition = 4;
    std::size_t catchTrials = 0;
};

bool catchesStandApart(const PlannedOrder& order) {
    if (!order.empty() && !order.front()) return false;
    return std::ranges::adjacent_find(order, [](const auto& a, const auto& b) { return !a && !b; }) == order.end();
}

bool runsAreShort(const PlannedOrder& order) {
    std::size_t run = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        run = order[i] && i > 0 && order[i] == order[i - 1] ? run + 1 : 1;
        if (run > kMaxInARow) return false;
    }
    return true;
}

/// Draws one of the valid orders of a block with equal probability; nothing if none was found.
std::optional<PlannedOrder> orderOfBlock(const PlannedBlocks& wanted, Random& random) {
    PlannedOrder order(wanted.catchTrials);
    for (std::size_t condition = 0; condition < wanted.conditions; ++condition) {
        order.insert(order.end(), wanted.perCondition, condition);
    }
    for (int tries = 0; tries < kTries; ++tries) {
        for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[random.below(i + 1)]);
        if (catchesStandApart(order) && runsAreShort(order)) return order;
    }
    return std::nullopt;
}

/// Draws each block separately. If a run across two blocks breaks the rule, all blocks are drawn again, so that all
/// valid orders of the phase are equally likely.
std::optional<PlannedOrder> orderOfPhase(const PlannedBlocks& wanted, std::uint64_t seed) {
    Random random(seed, fmt::format("plan, {}", nameOf(wanted.phase)));
    for (int tries = 0; tries < kTries; ++tries) {
        PlannedOrder all;
        for (std::size_t block = 0; block < wanted.blocks; ++block) {
            const auto order = orderOfBlock(wanted, random);
            if (!order) return std::nullopt;
            std::ranges::copy(*order, std::back_inserter(all));
        }
        if (runsAreShort(all)) return all;
    }
    return std::nullopt;
}

Result<void> validatePlan(const TrialPlanSettings& settings) {
    return checkFigures(
        {givenCount("the number of conditions", settings.conditions, 2, 16),
         givenCount("the number of rounds of familiarisation", settings.familiarisationRounds, 0, 20),
         givenCount("the number of blocks of training", settings.trainingBlocks, 0, 20),
         givenCount("trials of a condition in a block of training", settings.trainingPerCondition, 1, 20),
         givenCount("the number of blocks of the test", settings.blocks, 1, 50),
         givenCount("trials of a condition in a block of the test", settings.perCondition, 1, 20),
         givenCount("catch trials in a block of the test", settings.catchTrials, 0, 20)});
}

}  // namespace

Result<std::vector<PlannedTrial>> planTrials(const TrialPlanSettings& settings, std::uint64_t seed) {
    if (auto valid = validatePlan(settings); !valid) return failure(valid);
    std::vector<PlannedTrial> plan;
    const auto append = [&plan](TrialPhase phase, std::size_t block, std::optional<std::size_t> condition) {
        plan.push_back({plan.size() + 1, phase, block, condition});
    };
    for (std::size_t round = 1; round <= settings.familiarisationRounds; ++round) {
        for (std::size_t i = 0; i < settings.conditions; ++i) append(TrialPhase::Familiarisation, round, i);
        append(TrialPhase::Familiarisation, round, std::nullopt);
    }
    const PlannedBlocks phases[] = {
        {TrialPhase::Training, settings.conditions, settings.trainingBlocks, settings.trainingPerCondition, 0},
        {TrialPhase::Test, settings.conditions, settings.blocks, settings.perCondition, settings.catchTrials}};
    for (const auto& phase : phases) {
        const auto order = orderOfPhase(phase, seed);
        if (!order) {
            return invalid(
                "no order of {} times {} conditions and {} catch trials in a block was found with no condition "
                "more than {} times in a row, no catch trial first or right after another",
                phase.perCondition, phase.conditions, phase.catchTrials, kMaxInARow);
        }
        const std::size_t size = phase.conditions * phase.perCondition + phase.catchTrials;
        for (std::size_t i = 0; i < order->size(); ++i) append(phase.phase, 1 + i / size, (*order)[i]);
    }
    return plan;
}

Result<TrainingRule> TrainingRule::create(const TrainingRuleSettings& settings) {
    auto valid = checkFigures({givenCount("the size of a block of training", settings.blockSize, 1, 1e9),
                               givenAboveZero("the share of right answers that ends training", settings.share, 1)});
    if (!valid) return failure(valid);
    return TrainingRule(settings);
}

bool TrainingRule::done() const noexcept {
    return result_.reached || (result_.right.size() >= settings_.most && inBlock_ == 0);
}

std::optional<TrainingTrial> TrainingRule::next() const {
    if (done()) return std::nullopt;
    if (inBlock_ == 0) return TrainingTrial{result_.right.size() + 1, 1};
    return TrainingTrial{result_.right.size(), inBlock_ + 1};
}

Result<void> TrainingRule::answer(bool right) {
    if (done()) return invalid("training is over; no answer is accepted");
    if (inBlock_ == 0) result_.right.push_back(0);
    if (right) ++result_.right.back();
    if (++inBlock_ < settings_.blockSize) return {};
    inBlock_ = 0;
    const double needed = settings_.share * static_cast<double>(settings_.blockSize);
    result_.reached = static_cast<double>(result_.right.back()) >= needed - 1e-9;
    return {};
}

}  // namespace tacto
