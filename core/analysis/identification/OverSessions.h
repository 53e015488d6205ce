// OverSessions.h - one person over sessions: what changed against the first, and whether there is a trend.
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/base/Units.h"

namespace tacto {

/// One session; NaN where it was not measured.
struct SessionFigures {
    std::size_t number = 0;
    double days = 0;                       ///< since the person's first session
    Estimate detection;                    ///< 80 % right; mA, or a massager's intensity
    double tooStrong = kNaN, high = kNaN;  ///< lowest called too strong, highest of the range; mA or intensity
    Ohms impedance{kNaN};
    std::size_t n = 0, hits = 0;
    Estimate itCorrected_bits;  ///< NaN without test trials
};

/// Against the first session in which the figure was measured; NaN for that one and where it was not.
struct SessionChange {
    std::size_t number = 0;
    Estimate accuracy;        ///< less that of the first, Newcombe 95 %
    Estimate detection;       ///< divided by that of the first, as ratioOf()
    double tooStrong = kNaN;  ///< ratios; one reading has no interval
    double high = kNaN;
    double impedance = kNaN;
};

struct OverSessions {
    std::vector<SessionFigures> sessions;
    std::vector<SessionChange> againstFirst;  ///< one fewer
    /// Log odds of a right answer per day, profile likelihood; NaN for fewer than three sessions
    /// with test trials.
    Estimate trend;
    double smallestChange = kNaN;  ///< change of accuracy that two such sessions can show; NaN for fewer than two
};

/// a/b of two independent positive estimates with 95 % intervals [l, u]: from a/b exp(-√(ln²(a/l_a) + ln²(u_b/b))) to
/// a/b exp(√(ln²(u_a/a) + ln²(b/l_b))), the difference of the logarithms by Zou & Donner 2008 (Stat Med 27:1693). For
/// log-normal estimates it is exact. NaN where an estimate is not positive; ends are NaN where one has no interval.
[[nodiscard]] Estimate ratioOf(const Estimate& a, const Estimate& b) noexcept;

/// Errors: InvalidArgument for sessions whose days are not finite or go back, and for more hits than trials.
[[nodiscard]] Result<OverSessions> compareSessions(std::vector<SessionFigures> sessions);

/// The difference of two accuracies near `accuracy`, of `n` trials each, that leaves 0 outside the 95 % interval:
/// 1.96 √(2 p (1 - p)/n), 14 % for two sessions of 80 trials at 70 %. NaN for n = 0, and for an
/// accuracy of 0 or 1, where the spread is not known.
[[nodiscard]] double smallestChange(std::size_t n, double accuracy) noexcept;

}  // namespace tacto
