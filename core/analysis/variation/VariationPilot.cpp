#include "core/analysis/variation/VariationPilot.h"

#include <cmath>

#include "core/analysis/variation/VariationTrials.h"

namespace tacto {

std::size_t aboveChanceFrom(std::size_t trials, double chance) noexcept {
    std::size_t low = 0, high = trials + 1;
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (binomialAtLeast(middle, trials, chance) <= kAboveChanceLevel) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

double prevalenceAtLeast(std::size_t k, std::size_t n) noexcept {
    const double theta =
        truncatedBetaQuantile(static_cast<double>(k + 1), static_cast<double>(n - k + 1), kAboveChanceLevel, 1 - 0.95);
    return (theta - kAboveChanceLevel) / (1 - kAboveChanceLevel);
}

PilotOutlook outlookOf(const PilotPeople& population, std::size_t people, std::size_t trials, double chance) {
    PilotOutlook out;
    out.people = people;
    out.trials = trials;
    out.rightFrom = aboveChanceFrom(trials, chance);
    double above = 0;
    for (const double p : population.accuracies) above += binomialAtLeast(out.rightFrom, trials, p);
    const double all = static_cast<double>(population.all), n = static_cast<double>(people);
    out.allServed = std::pow(static_cast<double>(population.accuracies.size()) / all, n);
    out.allAboveChance = std::pow(above / all, n);
    out.prevalenceAll = prevalenceAtLeast(people, people);
    out.prevalenceButOne = prevalenceAtLeast(people - 1, people);
    out.width = intervalWidths(population.accuracies, trials);
    return out;
}

}  // namespace tacto
