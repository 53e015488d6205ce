// OverSessions.h - one person over sessions: what changed against the first, and whether there is a trend.
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/NaN.h"
#include "core/base/Result.h"
#include "core/base/Units.h"

namespace tacto {

/// One session; NaN where it was not measured.
struct SessionFigures {
    std::size_t number = 0;
    double days = 0;        ///< since the person's first session
    Estimate detection_ma;  ///< 80 % right
    Milliamps tooStrong{kNaN};
    Milliamps low{kNaN}, high{kNaN};  ///< range
    Ohms impedance{kNaN};
    std::size_t n = 0, hits = 0;
    double itCorrected_bits = kNaN;
    double naturalness = kNaN;
};

struct SessionChange {
    std::size_t number = 0;
    Estimate accuracy;        ///< less that of the first session, Newcombe 95 %
    Estimate detection;       ///< divided by that of the first; the intervals of the two logarithms, squared and added
    double tooStrong = kNaN;  ///< ratios; one reading has no interval
    double impedance = kNaN;
};

struct OverSessions {
    std::vector<SessionFigures> sessions;
    std::vector<SessionChange> againstFirst;  ///< one fewer
    /// Log odds of a right answer per day, profile likelihood; NaN for fewer than three sessions.
    Estimate trend;
    double smallestChange = kNaN;  ///< of accuracy that two such sessions can show; NaN for fewer than two
};

/// Errors: InvalidArgument for sessions whose days are not finite or go back, and for more hits than trials.
[[nodiscard]] Result<OverSessions> compareSessions(std::vector<SessionFigures> sessions);

/// The difference of two accuracies near `accuracy`, of `n` trials each, that leaves 0 outside the 95 % interval:
/// 1.96 √(2 p (1 - p)/n), 14 % for two sessions of 80 trials at 70 %. NaN for n = 0.
[[nodiscard]] double smallestChange(std::size_t n, double accuracy) noexcept;

}  // namespace tacto
