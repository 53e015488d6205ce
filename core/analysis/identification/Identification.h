// Identification.h - what one participant's identification session shows: which answers were given to which conditions,
// how far that is from guessing, and what may have disturbed it.
//
// Only test trials count, and catch trials are counted by themselves. "none" and "not sure" are answers like any other
// and are wrong. A trial without an answer is counted and enters nothing else. Definitions: science.md section 11.
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

// One presentation of an identification test and what was answered to it: what a pilot session
// records of each trial, and what every figure of its analysis is computed from.

enum class TrialPhase { Familiarisation, Training, Test };
inline constexpr Word<TrialPhase> kTrialPhases[] = {
    {"familiarisation", TrialPhase::Familiarisation}, {"training", TrialPhase::Training}, {"test", TrialPhase::Test}};
[[nodiscard]] constexpr std::string_view nameOf(TrialPhase phase) noexcept { return wordFor(kTrialPhases, phase); }
/// Errors: InvalidArgument naming the phases.
[[nodiscard]] Result<TrialPhase> trialPhaseFrom(std::string_view name);

inline constexpr std::string_view kCatchCondition = "catch";      ///< nothing is presented
inline constexpr std::string_view kNoneResponse = "none";         ///< "I felt nothing": right after a catch only
inline constexpr std::string_view kNotSureResponse = "not-sure";  ///< never right

struct IdentificationTrial {
    std::size_t number = 0;  ///< its number in the plan; skipped training leaves holes
    TrialPhase phase = TrialPhase::Test;
    std::size_t block = 0;
    std::string condition;  ///< a label, or kCatchCondition
    std::string response;  ///< a label, kNoneResponse or kNotSureResponse; empty: no answer came, also when asked again
    std::size_t attempt = 1;   ///< 2 where the first was interrupted or not answered
    double rt_s = kNaN;        ///< from the appearance of the targets; NaN without an answer
    Milliamps current{kNaN};   ///< delivered; NaN where the device has none (a massager)
    double interval_s = kNaN;  ///< between onsets of trains; NaN for a catch trial
    std::size_t trains = 0;    ///< delivered
};

/// The two features that a label names: "rough-high" has texture "rough" and pressure "high".
struct LabelFeatures {
    std::string_view texture;
    std::string_view pressure;
};
/// Views into `label`; the second part follows the first hyphen, and is empty without one.
[[nodiscard]] LabelFeatures featuresOf(std::string_view label) noexcept;

/// A table of answers against guessing.
struct ConfusionFigures {
    std::size_t n = 0;
    std::size_t hits = 0;
    double chance = kNaN;       ///< probability of a right answer by guessing among the names offered
    Estimate accuracy;          ///< Wilson 95 %
    double pChance = kNaN;      ///< P(X ≥ hits) by chance, one-sided, exact; 1 without trials
    double it_bits = kNaN;      ///< information transfer as counted; NaN without trials
    Estimate itCorrected_bits;  ///< without what chance adds to it: correctedInformation()
};

/// One feature, the other passed over: rows are its two values, columns the two and the other answers.
struct FeatureFigures {
    std::vector<std::string> values;                  ///< the values as first met in the labels
    std::vector<std::vector<std::size_t>> confusion;  ///< [presented][answered]
    ConfusionFigures figures;
    /// `values[0]` against `values[1]` in the trials that were answered with a label, 0.5 added to each count and
    /// the second value's distribution at 0: z(H) - z(F), and -(z(H) + z(F))/2, below 0 where `values[0]` is preferred.
    double dPrime = kNaN;
    double criterion = kNaN;
};

struct CatchFigures {
    std::size_t n = 0;
    std::size_t falseAlarms = 0;  ///< answered with a label
    Estimate rate;                ///< Clopper and Pearson 95 %: 0 of 10 still allows 31 %
};

struct BlockFigures {
    std::size_t block = 0;
    std::size_t n = 0;
    std::size_t hits = 0;
};

/// How often an answer was given, no matter what was presented.
struct AnswerShare {
    std::string response;
    std::size_t n = 0;
    Estimate share;  ///< Wilson 95 %
};

struct Identification {
    std::vector<std::string> labels;                  ///< rows
    std::vector<std::string> columns;                 ///< labels, then the other answers: "none", "not-sure"
    std::vector<std::vector<std::size_t>> confusion;  ///< [presented][answered]
    ConfusionFigures all;
    std::optional<FeatureFigures> texture;  ///< known where the labels are two by two
    std::optional<FeatureFigures> pressure;
    CatchFigures catches;
    std::size_t noAnswer = 0;  ///< trials and catch trials that were asked twice without an answer
    std::vector<AnswerShare> shares;
    std::vector<BlockFigures> blocks;
    /// Change of the log odds of a right answer per block, by a logistic model with its profile-likelihood interval.
    /// NaN where it cannot be determined: fewer than two blocks, or every answer right, or every one wrong.
    Estimate learning;
    /// Accuracy where the trial before it in the block was of the same condition, and of another. Catch trials and the
    /// first of a block have no such trial before them.
    BlockFigures afterSame, afterOther;        // `block` has no meaning in these
    std::vector<double> medianResponseTime_s;  ///< one for each label's rows, as presented; NaN without answers
};

/// `trials` in the order presented, whatever their phase; `labels` are the names offered, in the order of the rows,
/// with "none" and "not sure" beside them.
/// Errors: InvalidArgument for fewer than two labels, a label given twice or reserved, and a test trial whose condition
/// or response is neither a label nor one of the reserved words, or whose number comes a second time with an answer.
[[nodiscard]] Result<Identification> identify(std::span<const IdentificationTrial> trials,
                                              std::vector<std::string> labels);
/// Judges trials of which nothing else is known: rows are the conditions met, and the answers offered are the
/// conditions and all other answers met, each in the order first met. Errors: as identify().
[[nodiscard]] Result<Identification> identifyAsMet(std::span<const IdentificationTrial> trials);

}  // namespace tacto
