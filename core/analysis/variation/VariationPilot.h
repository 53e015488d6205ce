// VariationPilot.h - what a pilot of a few people can show: the paper plans three to five.
//
// A person shows the effect when they are served and their right answers lie above chance, p < 0.05 in a one-sided
// exact binomial test (statistics/Binomial.h). What k of n such people say of everybody is the Bayesian prevalence
// (statistics/Prevalence.h).
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <span>

#include "core/analysis/statistics/Estimate.h"

namespace tacto {

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
    double prevalenceAll = 0;     ///< then: at least this share of such people can do it (lower end of 95 %)
    double prevalenceButOne = 0;  ///< the share of such people where one of them does not
    Estimate width;               ///< width of one person's 95 % interval: median, 5 and 95 % over the served
};

/// `people` and `trials` ≥ 1; `chance` above 0, below 1.
[[nodiscard]] PilotOutlook outlookOf(const PilotPeople& population, std::size_t people, std::size_t trials,
                                     double chance);

}  // namespace tacto
