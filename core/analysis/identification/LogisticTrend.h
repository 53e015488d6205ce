// LogisticTrend.h - whether right answers become more frequent along something: blocks, days.
//
// Thread-safety: pure function.
#pragma once

#include <cstddef>
#include <span>

#include "core/analysis/statistics/Estimate.h"

namespace tacto {

/// `hits` of `n` right at `x`.
struct LogisticPoint {
    double x = 0;
    std::size_t n = 0;
    std::size_t hits = 0;
};

/// Slope b of logit p = a + b x by maximum likelihood, with the interval of slopes whose deviance lies within 3.84 of
/// the least (profile likelihood, 95 %). An end that the data leave open is infinite, and so is a slope that every
/// answer agrees with (all wrong up to some x, all right from there). NaN for fewer than two different x with trials,
/// and where all answers are right, or all wrong.
[[nodiscard]] Estimate logisticSlope(std::span<const LogisticPoint> points);

}  // namespace tacto
