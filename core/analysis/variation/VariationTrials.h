// VariationTrials.h - how many trials a pilot needs before its accuracy says something.
//
// Accuracies are those that a prediction gave its participants. Assumptions, to be said wherever a number of trials
// is shown: a participant's trials are independent with one probability of being right, and whole blocks are given
// (each condition equally often). Over several participants the counts are pooled in one Wilson interval; that people
// differ is taken into account by the design effect 1 + (m - 1)·rho with m trials per participant and
// rho = Var(accuracy) / (mean·(1 - mean)), by which the trials count less.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/Result.h"

namespace tacto {

struct TrialsWanted {
    double width = 0.1;            ///< width of the 95 % interval, upper end less lower; 0.02 to 1
    double chance = 0.25;          ///< the chance that the lower end must exceed; above 0, below 1
    double assurance = 0.8;        ///< probability with which a pilot reaches what is wanted; 0.5 to 0.999
    std::size_t conditions = 4;    ///< trials of a participant are a multiple of this
    std::size_t participants = 5;  ///< people in the pilot, for the pooled figures: the paper plans 3 to 5
    std::size_t most = 20'000;     ///< trials beyond which the search ends
};
/// Errors: InvalidArgument naming the field, its value and what is accepted.
[[nodiscard]] Result<void> validate(const TrialsWanted& wanted);

/// Probability, over the `accuracies`, that the Wilson interval of n trials is at most `width` wide.
[[nodiscard]] double widthReached(std::span<const double> accuracies, std::size_t n, double width) noexcept;
/// ... that its lower end lies above `chance`.
[[nodiscard]] double chanceExceeded(std::span<const double> accuracies, std::size_t n, double chance) noexcept;

/// Width of the Wilson interval of n trials: median and 5 to 95 % over the `accuracies` (not empty) and their outcomes.
/// Where there are more than 100, groups of similar ones.
[[nodiscard]] Estimate intervalWidths(std::span<const double> accuracies, std::size_t n);

/// One aim of a pilot that pools its participants.
struct PooledTrials {
    std::optional<std::size_t> total;           ///< trials of all participants; nothing when no number is enough
    std::optional<std::size_t> perParticipant;  ///< whole blocks
    double designEffect = 1;                    ///< at that many trials per participant; NaN when no number is enough
    /// Fewest participants with whom it can be reached at all, whatever each of them does.
    std::optional<std::size_t> participantsLeast;
};

struct TrialsNeeded {
    /// From this number on, every larger number of whole blocks is enough, too; nothing when `most` is not enough.
    std::optional<std::size_t> forWidth;
    std::optional<std::size_t> aboveChance;
    PooledTrials pooledForWidth;
    PooledTrials pooledAboveChance;
    double rho = 0;  ///< how alike a participant's trials are, 0 to 1

    /// Width of one participant's interval against the number of trials: median and 5 to 95 % over accuracies and
    /// outcomes.
    struct Point {
        std::size_t trials = 0;
        Estimate width;
    };
    std::vector<Point> curve;
};

/// Errors: as validate(); InvalidArgument without accuracies, or for one outside 0 to 1.
[[nodiscard]] Result<TrialsNeeded> trialsNeeded(std::span<const double> accuracies, const TrialsWanted& wanted);

// What a pilot of a few people can show: the paper plans three to five.
//
// A person shows the effect when they are served and their right answers lie above chance, p < 0.05 in a one-sided
// exact binomial test. What k of n such people say of everybody is the Bayesian prevalence (statistics/Estimate.h).

/// The population that a pilot draws from.
struct PilotPeople {
    std::span<const double> accuracies;  ///< accuracy of each person served, 0 to 1; not empty
    std::size_t all = 0;                 ///< served or not; at least as many
};

struct PilotOutlook {
    std::size_t people = 0;
    std::size_t trials = 0;       ///< trials of each person
    std::size_t rightFrom = 0;    ///< so many right answers are above chance; trials + 1 where no number is
    double allServed = 0;         ///< probability that every one is served
    double allAboveChance = 0;    ///< probability that every one is served and above chance
    double prevalenceAll = 0;     ///< in that case, at least this share of such people can do it (lower end of 95 %)
    double prevalenceButOne = 0;  ///< the share of such people where one of them cannot
    Estimate width;               ///< width of one person's 95 % interval: median, 5 and 95 % over the served
};

/// `people` and `trials` ≥ 1; `chance` above 0, below 1.
[[nodiscard]] PilotOutlook outlookOf(const PilotPeople& population, std::size_t people, std::size_t trials,
                                     double chance);

}  // namespace tacto
