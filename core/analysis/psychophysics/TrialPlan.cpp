#include "core/analysis/psychophysics/TrialPlan.h"

#include <algorithm>
#include <iterator>

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

/// Uniform among the orders of one block that obey; nothing when none was found.
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

/// Each block is drawn by itself, and all of them again when a run crosses their ends, so that whole orders are equally
/// likely.
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
    const struct {
        std::string_view name;
        std::size_t value;
        std::size_t low;
        std::size_t high;
    } asked[] = {{"conditions", settings.conditions, 2, 16},
                 {"rounds of familiarisation", settings.familiarisationRounds, 0, 20},
                 {"blocks of training", settings.trainingBlocks, 0, 20},
                 {"trials of a condition in a block of training", settings.trainingPerCondition, 1, 20},
                 {"blocks of the test", settings.blocks, 1, 50},
                 {"trials of a condition in a block of the test", settings.perCondition, 1, 20},
                 {"catch trials in a block of the test", settings.catchTrials, 0, 20}};
    for (const auto& each : asked) {
        if (each.value < each.low || each.value > each.high) {
            return fail(ErrorCode::InvalidArgument, "{} {}; {} to {} are accepted", each.value, each.name, each.low,
                        each.high);
        }
    }
    return {};
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
            return fail(ErrorCode::InvalidArgument,
                        "no order of {} times {} conditions and {} catch trials in a block was found with no condition "
                        "more than {} times in a row, no catch trial first or right after another",
                        phase.perCondition, phase.conditions, phase.catchTrials, kMaxInARow);
        }
        const std::size_t size = phase.conditions * phase.perCondition + phase.catchTrials;
        for (std::size_t i = 0; i < order->size(); ++i) append(phase.phase, 1 + i / size, (*order)[i]);
    }
    return plan;
}

}  // namespace tacto
