// TrialPlan.h - which condition comes when: drawn from the seed and stored before the first trial (pilot.md section 4);
// and when training ends.
//
// Familiarisation: named rounds of every condition in order and one empty presentation. Training: blocks with each
// condition equally often. Test: blocks with each condition equally often and a few catch trials (nothing presented).
// In training and test no condition comes more than three times in a row, across blocks too; in the test no catch trial
// comes first in a block or right after another. Among the orders that obey, each phase's order is uniformly random.
// Numbers belong to the plan: where training ends early its later numbers are not used.
//
// Thread-safety: values; pure functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/analysis/identification/Identification.h"
#include "core/base/Result.h"

namespace tacto {

struct TrialPlanSettings {
    std::size_t conditions = 4;             ///< 2 to 16
    std::size_t familiarisationRounds = 3;  ///< 0 to 20
    std::size_t trainingBlocks = 4;         ///< 0 to 20
    std::size_t trainingPerCondition = 2;   ///< in a block, 1 to 20
    std::size_t blocks = 5;                 ///< in the test, 1 to 50
    std::size_t perCondition = 4;           ///< in a block, 1 to 20
    std::size_t catchTrials = 2;            ///< in a block, 0 to 20
};

struct PlannedTrial {
    std::size_t number = 0;  ///< from 1, over the whole plan
    TrialPhase phase = TrialPhase::Test;
    std::size_t block = 0;                 ///< from 1 within the phase; in familiarisation the round
    std::optional<std::size_t> condition;  ///< 0 to conditions − 1; nothing: a catch trial, nothing is presented
    bool operator==(const PlannedTrial&) const = default;
};

inline constexpr std::size_t kMaxInARow = 3;

/// Errors: InvalidArgument naming the setting, its value and what is accepted, or when no order was found that obeys.
[[nodiscard]] Result<std::vector<PlannedTrial>> planTrials(const TrialPlanSettings& settings, std::uint64_t seed);

// Decides when training ends: after a block with 7 of 8 right, or after four blocks (pilot.md section 4).
//
// A participant who does not reach it takes the test all the same.

struct TrainingRuleSettings {
    std::size_t blockSize = 8;  ///< ≥ 1
    double share = 7.0 / 8;     ///< right answers of a block that end it; above 0 to 1
    std::size_t most = 4;       ///< blocks; 0: no training
};

struct TrainingTrial {
    std::size_t block = 0;  ///< from 1
    std::size_t trial = 0;  ///< from 1 within the block
};

struct TrainingResult {
    std::vector<std::size_t> right;  ///< right answers in each block that has begun
    bool reached = false;            ///< the share was reached
};

class TrainingRule {
public:
    /// Errors: InvalidArgument naming the setting, its value and what is accepted.
    [[nodiscard]] static Result<TrainingRule> create(const TrainingRuleSettings& settings);

    /// Nothing when done().
    [[nodiscard]] std::optional<TrainingTrial> next() const;
    /// Errors: InvalidArgument when done().
    [[nodiscard]] Result<void> answer(bool right);
    [[nodiscard]] bool done() const noexcept;
    [[nodiscard]] const TrainingResult& result() const noexcept { return result_; }

private:
    explicit TrainingRule(const TrainingRuleSettings& settings) noexcept : settings_(settings) {}

    TrainingRuleSettings settings_;
    std::size_t inBlock_ = 0;  // Answered in the current block
    TrainingResult result_;
};

}  // namespace tacto
