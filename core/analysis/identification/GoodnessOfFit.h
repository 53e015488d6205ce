// GoodnessOfFit.h - whether the answers are those that a model predicts: G = 2 Σ n ln(n/(N p)) over the cells of every
// row, and how often the model itself would give a G as large.
//
// The probability is by Monte Carlo over multinomials with each row's own number of trials, since cells are too few for
// χ². Equal values of G are ordered at random, so that p is even between 0 and 1 where the model holds, also for tables
// of few outcomes.
//
// Thread-safety: pure function.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

struct GoodnessOfFit {
    double g = 0;  ///< infinite where an answer was given that the model excludes; p is 0 then
    double p = 1;
};

struct FitOptions {
    std::size_t draws = 10'000;
    std::uint64_t seed = 1;
};

/// `predicted` has the shape of `counts`; each row sums to 1. Rows without trials count nothing.
/// Errors: InvalidArgument for another shape, a probability that is negative or not finite, a row that does not sum to
/// 1 within 1e-6, or fewer than 1000 draws.
[[nodiscard]] Result<GoodnessOfFit> goodnessOfFit(std::span<const std::vector<std::size_t>> counts,
                                                  std::span<const std::vector<double>> predicted,
                                                  const FitOptions& options = {});

}  // namespace tacto
