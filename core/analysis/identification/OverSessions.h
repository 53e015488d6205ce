// OverSessions.h - compares one person's sessions: changes since the first session, the trend, and which of several
// encodings suits the person.
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

/// The figures of one session; NaN if not measured.
struct SessionFigures {
    std::size_t number = 0;
    double days = 0;                       ///< since the person's first session
    Estimate detection;                    ///< level with 80 % right answers; mA, or a massager's intensity
    double tooStrong = kNaN, high = kNaN;  ///< lowest level called too strong, highest of the range; mA or intensity
    Ohms impedance{kNaN};
    std::size_t n = 0, hits = 0;
    Estimate itCorrected_bits;       ///< NaN without test trials
    std::string participant = {};    ///< name as shown
    std::string encoding = {};       ///< empty: not stated
    double low = kNaN;               ///< lowest of the range
    double medianResponse_s = kNaN;  ///< of the test
};

/// Changes relative to the first session that has the figure. NaN for that session and for unmeasured figures.
struct SessionChange {
    std::size_t number = 0;
    Estimate accuracy;        ///< difference from the first session, Newcombe 95 %
    Estimate detection;       ///< ratio to the first session by ratioOf()
    double tooStrong = kNaN;  ///< ratio; no interval, because each session has one reading
    double high = kNaN;
    double impedance = kNaN;
};

struct OverSessions {
    std::vector<SessionFigures> sessions;
    std::vector<SessionChange> againstFirst;  ///< one entry fewer than `sessions`
    /// Change of the log odds of a right answer per day, profile likelihood; NaN for fewer than three sessions with
    /// test trials.
    Estimate trend;
    double smallestChange = kNaN;  ///< smallest change of accuracy that two such sessions can show; NaN for one
};

/// Ratio a/b of two independent positive estimates with 95 % intervals [l, u]: from a/b exp(-√(ln²(a/l_a) +
/// ln²(u_b/b))) to a/b exp(√(ln²(u_a/a) + ln²(b/l_b))), by Zou & Donner 2008 for the difference of logarithms (Stat Med
/// 27:1693). Exact for log-normal estimates. NaN if an estimate is not positive; ends are NaN without an interval.
[[nodiscard]] Estimate ratioOf(const Estimate& a, const Estimate& b) noexcept;

/// Errors: InvalidArgument if the days are not finite or decrease, or if there are more hits than trials.
[[nodiscard]] Result<OverSessions> compareSessions(std::vector<SessionFigures> sessions);

/// Smallest difference of two accuracies near `accuracy`, each from `n` trials, with a 95 % interval that excludes 0:
/// 1.96 √(2 p (1 - p)/n), for example 14 % for two sessions of 80 trials at 70 %. NaN for n = 0 or an accuracy of 0 or
/// 1, because the spread is then unknown.
[[nodiscard]] double smallestChange(std::size_t n, double accuracy) noexcept;

// The following part tests whether right answers become more frequent over blocks or days.

/// Of `n` answers at `x`, `hits` were right.
struct LogisticPoint {
    double x = 0;
    std::size_t n = 0;
    std::size_t hits = 0;
};

/// Slope b of logit p = a + b x by maximum likelihood. The 95 % interval holds all slopes with a deviance within 3.84
/// of the minimum (profile likelihood). An end that the data do not limit is infinite. The slope itself is infinite if
/// a single x separates all wrong answers from all right ones. NaN with trials at fewer than two different x, or if all
/// answers are right, or all wrong.
[[nodiscard]] Estimate logisticSlope(std::span<const LogisticPoint> points);

// The following part is about several encodings (the same stimuli with other names) within one person; people together
// are compared in EncodingsOverPeople.h.
//
// By symmetry an ideal observer is equally good with each encoding, so the comparison shows how well the names fit.
// Each session has one encoding, so the trials of two encodings are independent samples.

/// One person's results with one encoding, all sessions together; NaN or 0 if nothing was recorded.
struct EncodingResult {
    std::string encoding;
    std::size_t n = 0;
    std::size_t hits = 0;
    std::size_t trainingBlocks = 0;
    double medianResponse_s = kNaN;
    double naturalness = kNaN;  ///< mean of the conditions' ratings
    std::size_t sessions = 0;   ///< number of added sessions
    Estimate itCorrected_bits = {};
};

/// The encodings that a person had, in the order of use, and the one that the person preferred; empty if not asked.
struct EncodingPreference {
    std::vector<std::string> had;
    std::string preferred = {};
};

/// Counts the people who preferred each encoding. Never tested statistically: even five of five give only p = 0.06.
[[nodiscard]] std::map<std::string, std::size_t> preferences(std::span<const EncodingPreference> people);

/// Order of the encodings for the `enrolled`-th person (from 0), as indices: a row of a Williams design (1949), in
/// which each encoding is equally often in each place and after each other encoding. 2 encodings: AB, BA; 3: six
/// orders. Empty for 0 encodings.
[[nodiscard]] std::vector<std::size_t> williamsOrder(std::size_t encodings, std::size_t enrolled);
/// Number of rows of the design. A group is balanced if its size is a multiple of this. 1 for fewer than two encodings.
[[nodiscard]] std::size_t williamsRows(std::size_t encodings) noexcept;

}  // namespace tacto
