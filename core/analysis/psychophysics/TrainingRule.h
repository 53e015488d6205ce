// TrainingRule.h - when training ends: after a block with 7 of 8 right, or after four blocks (pilot.md section 4).
//
// A participant who does not reach it goes on to the test all the same.
//
// Thread-safety: none; one owner.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

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
