// Identification.h - analyses one participant's identification session: which answers were given to which conditions,
// how much better than guessing they are, and what may have disturbed them.
//
// Only test trials are analysed; catch trials have their own count. "none" and "not sure" are ordinary answers and
// always wrong. A trial without an answer is only counted. Definitions: science.md section 11.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/base/Units.h"
#include "core/base/Words.h"

namespace tacto {

// One presentation in an identification test and its answer. A pilot session records this for each trial, and every
// figure of the analysis is computed from it.

enum class TrialPhase { Familiarisation, Training, Test };
inline constexpr Word<TrialPhase> kTrialPhases[] = {
    {"familiarisation", TrialPhase::Familiarisation}, {"training", TrialPhase::Training}, {"test", TrialPhase::Test}};
[[nodiscard]] constexpr std::string_view nameOf(TrialPhase phase) noexcept { return wordFor(kTrialPhases, phase); }
/// Errors: InvalidArgument listing the phases.
[[nodiscard]] Result<TrialPhase> trialPhaseFrom(std::string_view name);

inline constexpr std::string_view kCatchCondition = "catch";      ///< nothing is presented
inline constexpr std::string_view kNoneResponse = "none";         ///< "I felt nothing"; right only after a catch trial
inline constexpr std::string_view kNotSureResponse = "not-sure";  ///< never a right answer

struct IdentificationTrial {
    std::size_t number = 0;  ///< number in the plan; skipped training trials leave gaps
    TrialPhase phase = TrialPhase::Test;
    std::size_t block = 0;
    std::string condition;  ///< a label, or kCatchCondition
    std::string response;   ///< a label, kNoneResponse or kNotSureResponse; empty if no answer came, even when repeated
    std::size_t attempt = 1;   ///< 2 if the first attempt was interrupted or not answered
    double rt_s = kNaN;        ///< response time from the appearance of the targets; NaN without an answer
    Milliamps current{kNaN};   ///< delivered current; NaN if the device reports none (a massager)
    double interval_s = kNaN;  ///< between the onsets of two trains; NaN for a catch trial
    std::size_t trains = 0;    ///< number of delivered trains
};

/// The two features in a label: "rough-high" has texture "rough" and pressure "high".
struct LabelFeatures {
    std::string_view texture;
    std::string_view pressure;
};
/// Returns views into `label`. `pressure` is the text after the first hyphen, or empty if there is no hyphen.
[[nodiscard]] LabelFeatures featuresOf(std::string_view label) noexcept;

/// The figures of a table of answers, compared with guessing.
struct ConfusionFigures {
    std::size_t n = 0;
    std::size_t hits = 0;
    double chance = kNaN;       ///< probability that a random guess among the offered names is right
    Estimate accuracy;          ///< Wilson 95 %
    double pChance = kNaN;      ///< probability of at least `hits` by chance, one-sided, exact; 1 without trials
    double it_bits = kNaN;      ///< information transfer from the raw counts; NaN without trials
    Estimate itCorrected_bits;  ///< without the contribution of chance: correctedInformation()
};

/// One feature regardless of the other. Rows: its two values; columns: the two values and the other answers.
struct FeatureFigures {
    std::vector<std::string> values;                  ///< in the order of first appearance in the labels
    std::vector<std::vector<std::size_t>> confusion;  ///< [presented][answered]
    ConfusionFigures figures;
    /// Sensitivity and bias between the two values, from the trials answered with a label, with 0.5 added to each
    /// count: d' = z(H) - z(F) and criterion = -(z(H) + z(F))/2, which is negative if `values[0]` is preferred.
    double dPrime = kNaN;
    double criterion = kNaN;
};

struct CatchFigures {
    std::size_t n = 0;
    std::size_t falseAlarms = 0;  ///< catch trials answered with a label
    Estimate rate;                ///< Clopper and Pearson 95 %; even 0 of 10 allows up to 31 %
};

struct BlockFigures {
    std::size_t block = 0;
    std::size_t n = 0;
    std::size_t hits = 0;
};

/// How often an answer was given, regardless of the condition.
struct AnswerShare {
    std::string response;
    std::size_t n = 0;
    Estimate share;  ///< Wilson 95 %
};

struct Identification {
    std::vector<std::string> labels;                  ///< names of the rows
    std::vector<std::string> columns;                 ///< names of the columns: labels, then "none" and "not-sure"
    std::vector<std::vector<std::size_t>> confusion;  ///< [presented][answered]
    ConfusionFigures all;
    std::optional<FeatureFigures> texture;  ///< set only if the labels combine two textures with two pressures
    std::optional<FeatureFigures> pressure;
    CatchFigures catches;
    std::size_t noAnswer = 0;  ///< trials, catch trials included, without an answer in both attempts
    std::vector<AnswerShare> shares;
    std::vector<BlockFigures> blocks;
    /// Change of the log odds of a right answer per block: logistic model with profile-likelihood interval. NaN if
    /// undefined: fewer than two blocks, or all answers right, or all wrong.
    Estimate learning;
    /// Accuracy if the previous trial of the block had the same condition, or another one. Catch trials and the first
    /// trial of a block are not included.
    BlockFigures afterSame, afterOther;        // `block` is unused here
    std::vector<double> medianResponseTime_s;  ///< one per label as presented; NaN without answers
};

/// Analyses one session. `trials`: in the order presented, all phases. `labels`: the names offered, in row order;
/// "none" and "not sure" are added. Errors: InvalidArgument for fewer than two labels, a repeated or reserved label, a
/// test trial with a condition or response that is neither a label nor a reserved word, or a trial number that is
/// answered twice.
[[nodiscard]] Result<Identification> identify(std::span<const IdentificationTrial> trials,
                                              std::vector<std::string> labels);
/// Analyses trials without a known list of labels. Rows are the conditions found; the offered answers are these
/// conditions and all other answers found, in the order of first appearance. Errors: as identify().
[[nodiscard]] Result<Identification> identifyAsMet(std::span<const IdentificationTrial> trials);

}  // namespace tacto
