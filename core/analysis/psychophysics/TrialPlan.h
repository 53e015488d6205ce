// TrialPlan.h - plans the order of the conditions from the seed before the first trial (pilot.md section 4), and
// decides when training ends.
//
// Familiarisation: named rounds with every condition in order and one empty presentation. Training: blocks with each
// condition equally often. Test: the same and a few catch trials (nothing is presented). In training and test no
// condition comes more than three times in a row, also across blocks. In the test no catch trial comes first in a block
// or directly after another. Each phase's order is drawn with equal probability from all orders that follow these
// rules. If training ends early, the numbers of its remaining trials stay unused.
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
    std::size_t trainingPerCondition = 2;   ///< trials per block, 1 to 20
    std::size_t blocks = 5;                 ///< blocks in the test, 1 to 50
    std::size_t perCondition = 4;           ///< trials per block, 1 to 20
    std::size_t catchTrials = 2;            ///< catch trials per block, 0 to 20
};

struct PlannedTrial {
    std::size_t number = 0;  ///< from 1, over the whole plan
    TrialPhase phase = TrialPhase::Test;
    std::size_t block = 0;                 ///< from 1 within the phase; the round in familiarisation
    std::optional<std::size_t> condition;  ///< 0 to conditions − 1; empty: nothing is presented (a catch trial)
    bool operator==(const PlannedTrial&) const = default;
};

inline constexpr std::size_t kMaxInARow = 3;

/// Errors: InvalidArgument naming the setting, its value and what is accepted, or if no valid order was found.
[[nodiscard]] Result<std::vector<PlannedTrial>> planTrials(const TrialPlanSettings& settings, std::uint64_t seed);

// Training ends after a block with 7 of 8 right answers, or after four blocks (pilot.md section 4).
//
// A participant who does not reach this share still takes the test.

struct TrainingRuleSettings {
    std::size_t blockSize = 8;  ///< ≥ 1
    double share = 7.0 / 8;     ///< share of right answers in a block that ends training; above 0 to 1
    std::size_t most = 4;       ///< largest number of blocks; 0: no training
};

struct TrainingTrial {
    std::size_t block = 0;  ///< from 1
    std::size_t trial = 0;  ///< from 1 within the block
};

struct TrainingResult {
    std::vector<std::size_t> right;  ///< number of right answers in each block begun so far
    bool reached = false;            ///< true if a block reached the required share
};

class TrainingRule {
public:
    /// Errors: InvalidArgument naming the setting, its value and what is accepted.
    [[nodiscard]] static Result<TrainingRule> create(const TrainingRuleSettings& settings);

    /// Returns the next trial; nothing if done().
    [[nodiscard]] std::optional<TrainingTrial> next() const;
    /// Errors: InvalidArgument if done().
    [[nodiscard]] Result<void> answer(bool right);
    [[nodiscard]] bool done() const noexcept;
    [[nodiscard]] const TrainingResult& result() const noexcept { return result_; }

private:
    explicit TrainingRule(const TrainingRuleSettings& settings) noexcept : settings_(settings) {}

    TrainingRuleSettings settings_;
    std::size_t inBlock_ = 0;  // answers in the current block
    TrainingResult result_;
};

}  // namespace tacto
