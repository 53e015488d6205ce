// PredictedFit.h - do the answers agree with what was predicted of the participant? (pilot.md section 8)
//
// G = 2 Σ n ln(n / (N p)) per condition and over all, where N p is the sum of the trials' probabilities. p is the share
// of simulated sessions, each trial drawn from its own probabilities, whose G is larger; a session with the same G
// counts by a fraction drawn from the seed, because G of few trials takes few values. So p is even between 0 and 1
// when the prediction is true. An answer whose probability is 0 makes G infinite.
//
// Thread-safety: pure functions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

struct PredictedTrial {
    std::size_t condition = 0;
    std::size_t response = 0;           ///< index into `probabilities`
    std::vector<double> probabilities;  ///< probability of each response; as many for every trial, ≥ 0, their sum 1
};

struct FitFigure {
    double g = 0;  ///< ≥ 0
    double p = 1;  ///< 0 to 1
};

struct PredictedFit {
    FitFigure all;
    std::vector<FitFigure> rows;                 ///< by condition; NaN where it has no trial
    std::vector<std::vector<double>> predicted;  ///< by condition: mean probabilities; empty where it has no trial
};

/// Errors: InvalidArgument naming the value and what is accepted; no trials, `conditions` or `draws` of 0, a condition
/// or response out of range, a probability that is not 0 to 1, a sum that is not 1 within 1e-6.
[[nodiscard]] Result<PredictedFit> fitOf(std::span<const PredictedTrial> trials, std::size_t conditions,
                                         std::uint64_t seed, std::size_t draws = 10'000);

}  // namespace tacto
