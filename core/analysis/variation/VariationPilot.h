// VariationPilot.h - what a pilot of a few people can show: the paper plans three to five.
//
// A person shows the effect when they are served and their right answers lie above chance, p < 0.05 in a one-sided
// exact binomial test. What k of n such people say of everybody is the Bayesian prevalence (Ince et al. 2021,
// doi:10.7554/eLife.62461): with an even prior, and a test that lets 5 % through who cannot do it,
// θ = 0.05 + 0.95·γ is Beta(k + 1, n - k + 1) between 0.05 and 1, where γ is the share of people who can.
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <span>

#include "core/analysis/statistics/Estimate.h"

namespace tacto {

inline constexpr double kAboveChanceLevel = 0.05;

/// The population that a pilot draws from.
struct PilotPeople {
    std::span<const double> accuracies;  ///< of the served, 0 to 1; not empty
    std::size_t all = 0;                 ///< served or not; at least as many
};

struct PilotOutlook {
    std::size_t people = 0;
    std::size_t trials = 0;       ///< of each
    std::size_t rightFrom = 0;    ///< so many right answers are above chance; trials + 1 where no number is
    double allServed = 0;         ///< probability that every one is served
    double allAboveChance = 0;    ///< probability that every one is served and above chance
    double prevalenceAll = 0;     ///< then: at least this share of such people can do it (95 %)
    double prevalenceButOne = 0;  ///< the same when one of them does not
    Estimate width;               ///< of one person's 95 % interval: median, 5 and 95 % over the served
};

/// `people` and `trials` ≥ 1; `chance` above 0, below 1.
[[nodiscard]] PilotOutlook outlookOf(const PilotPeople& population, std::size_t people, std::size_t trials,
                                     double chance);

/// Lower end of a one-sided 95 % interval of the share γ when `k` of `n` people were above chance; k ≤ n.
[[nodiscard]] double prevalenceAtLeast(std::size_t k, std::size_t n) noexcept;

/// Fewest right answers of `trials` with P(X ≥ k) ≤ 0.05 by chance; trials + 1 where no number is enough.
[[nodiscard]] std::size_t aboveChanceFrom(std::size_t trials, double chance) noexcept;

}  // namespace tacto
