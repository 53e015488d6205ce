// VariationTrials.h - computes how many trials a pilot needs before its accuracy is meaningful.
//
// The accuracies are those predicted for each participant. State these assumptions wherever a number of trials is
// shown: a participant's trials are independent with one probability of being right, and blocks are complete (each
// condition equally often). For several participants the trials are pooled in one Wilson interval. Because people
// differ, the design effect 1 + (m - 1)·rho reduces the effective number of trials, with m trials per participant and
// rho = Var(accuracy) / (mean·(1 - mean)).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/Result.h"

namespace tacto {

struct TrialsWanted {
    double width = 0.1;            ///< width of the 95 % interval: upper end minus lower end; 0.02 to 1
    double chance = 0.25;          ///< chance level that the lower end must exceed; above 0, below 1
    double assurance = 0.8;        ///< probability that a pilot reaches its aim; 0.5 to 0.999
    std::size_t conditions = 4;    ///< each participant's number of trials is a multiple of this
    std::size_t participants = 5;  ///< people in the pilot, for the pooled figures; the paper plans 3 to 5
    std::size_t most = 20'000;     ///< the search ends at this number of trials
};
/// Errors: InvalidArgument naming the field, its value and what is accepted.
[[nodiscard]] Result<void> validate(const TrialsWanted& wanted);

/// Probability, averaged over the `accuracies`, that the Wilson interval of n trials is at most `width` wide.
[[nodiscard]] double widthReached(std::span<const double> accuracies, std::size_t n, double width) noexcept;
/// Probability, averaged over the `accuracies`, that the lower end of this interval lies above `chance`.
[[nodiscard]] double chanceExceeded(std::span<const double> accuracies, std::size_t n, double chance) noexcept;

/// Width of the Wilson interval of n trials: median and 5 to 95 % over the `accuracies` (not empty) and their outcomes.
/// More than 100 accuracies are combined into groups of similar values.
[[nodiscard]] Estimate intervalWidths(std::span<const double> accuracies, std::size_t n);

/// The trials needed for one aim of a pilot that pools its participants.
struct PooledTrials {
    std::optional<std::size_t> total;           ///< trials of all participants; empty if no number is enough
    std::optional<std::size_t> perParticipant;  ///< a whole number of blocks
    double designEffect = 1;                    ///< for that many trials per participant; NaN if no number is enough
    /// Smallest number of participants that can reach the aim at all, with any number of trials each.
    std::optional<std::size_t> participantsLeast;
};

struct TrialsNeeded {
    /// The smallest number of trials from which every larger number of whole blocks is enough; empty if `most` is not.
    std::optional<std::size_t> forWidth;
    std::optional<std::size_t> aboveChance;
    PooledTrials pooledForWidth;
    PooledTrials pooledAboveChance;
    double rho = 0;  ///< correlation between a participant's trials, 0 to 1

    /// Width of one participant's interval at a number of trials: median and 5 to 95 % over accuracies and outcomes.
    struct Point {
        std::size_t trials = 0;
        Estimate width;
    };
    std::vector<Point> curve;
};

/// Errors: those of validate(); InvalidArgument without accuracies, or for one outside 0 to 1.
[[nodiscard]] Result<TrialsNeeded> trialsNeeded(std::span<const double> accuracies, const TrialsWanted& wanted);

// What a pilot of a few people can show; the paper plans three to five people.
//
// A person shows the effect if they are served and have more right answers than chance (p < 0.05, one-sided exact
// binomial test). Bayesian prevalence (statistics/Estimate.h) tells what k of n such people say about the population.

/// The population that a pilot draws from.
struct PilotPeople {
    std::span<const double> accuracies;  ///< of each person for whom all conditions are valid, 0 to 1; not empty
    std::size_t all = 0;                 ///< number of all people
};

struct PilotOutlook {
    std::size_t people = 0;
    std::size_t trials = 0;       ///< trials of each person
    std::size_t rightFrom = 0;    ///< smallest number of right answers above chance; trials + 1 if there is none
    double allServed = 0;         ///< probability that everyone is served
    double allAboveChance = 0;    ///< probability that everyone is served and above chance
    double prevalenceAll = 0;     ///< if so: the share of such people is at least this (lower end of 95 %)
    double prevalenceButOne = 0;  ///< the same share if all but one succeed
    Estimate width;               ///< width of one person's 95 % interval: median, 5 and 95 % over the served
};

/// `people` and `trials` ≥ 1; `chance` above 0, below 1.
[[nodiscard]] PilotOutlook outlookOf(const PilotPeople& population, std::size_t people, std::size_t trials,
                                     double chance);

}  // namespace tacto
