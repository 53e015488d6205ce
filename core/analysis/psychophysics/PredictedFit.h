// PredictedFit.h - tests whether a participant's answers agree with the prediction (pilot.md section 8).
//
// G = 2 Σ n ln(n / (N p)) per condition and overall; N p is the sum of the trials' probabilities. p is the share of
// simulated sessions with a larger G; each simulated trial is drawn from its own probabilities. G takes few values with
// few trials, so sessions with the same G are included only by a fraction drawn from the seed. p is then uniform
// between 0 and 1 if the prediction is true. An answer with probability 0 makes G infinite.
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
    std::vector<double> probabilities;  ///< probability of each response, ≥ 0, with sum 1; equally many in every trial
};

struct FitFigure {
    double g = 0;  ///< ≥ 0
    double p = 1;  ///< 0 to 1
};

struct PredictedFit {
    FitFigure all;
    std::vector<FitFigure> rows;                 ///< by condition; NaN for a condition without trials
    std::vector<std::vector<double>> predicted;  ///< by condition: mean probabilities; empty without trials
};

/// Errors: InvalidArgument naming the value and what is accepted, for no trials, 0 `conditions` or `draws`, a condition
/// or response out of range, a probability outside 0 to 1, or a sum that differs from 1 by more than 1e-6.
[[nodiscard]] Result<PredictedFit> fitOf(std::span<const PredictedTrial> trials, std::size_t conditions,
                                         std::uint64_t seed, std::size_t draws = 10'000);

}  // namespace tacto
