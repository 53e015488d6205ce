// OverSessions.h - one person over sessions: what changed against the first, whether there is a trend, and which of
// several encodings suits them.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/identification/Identification.h"
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
    Estimate accuracy;        ///< minus the first session's, Newcombe 95 %
    Estimate detection;       ///< divided by the first session's, as ratioOf()
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

// Whether right answers become more frequent along something: blocks, days.

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

// Which of several encodings suits people: the same stimuli under other names, compared within a person.
//
// An ideal observer does equally well with each by symmetry, so what is asked is whether names fit. One session has one
// encoding, so trials of two encodings are independent samples.

/// One person's results with one encoding; NaN and 0 where nothing was recorded.
struct EncodingResult {
    std::string encoding;
    std::size_t n = 0;
    std::size_t hits = 0;
    std::size_t trainingBlocks = 0;
    double medianResponse_s = kNaN;
    double naturalness = kNaN;  ///< mean of the conditions' ratings
};

struct EncodingPair {
    std::string a, b;
    Estimate difference;  ///< accuracy of a minus accuracy of b, Newcombe 95 %
};

struct EncodingComparison {
    std::vector<EncodingResult> encodings;  ///< in the order in which the person had them
    std::vector<EncodingPair> pairs;        ///< the later less the earlier
    std::string preferred;                  ///< as the person said; empty: not asked
};

[[nodiscard]] EncodingComparison compareEncodings(std::vector<EncodingResult> inOrder, std::string preferred = {});

/// How many people preferred each. Shown and never tested: if five of five people agree, p is 0.06.
[[nodiscard]] std::map<std::string, std::size_t> preferences(std::span<const EncodingComparison> people);

/// The order in which the `enrolled`-th person (from 0) has `encodings` of them, as indices: a row of a Williams design
/// (1949), in which each encoding stands in each place and follows each other equally often. 2: AB, BA; 3: six orders.
/// Empty for 0 encodings.
[[nodiscard]] std::vector<std::size_t> williamsOrder(std::size_t encodings, std::size_t enrolled);
/// Rows of the design: `people` is balanced where it is a multiple of this. 1 for fewer than two encodings.
[[nodiscard]] std::size_t williamsRows(std::size_t encodings) noexcept;

}  // namespace tacto
