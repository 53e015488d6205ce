#include "core/analysis/variation/VariationPilot.h"

#include <cmath>

#include "core/analysis/statistics/Binomial.h"
#include "core/analysis/statistics/Prevalence.h"
#include "core/analysis/variation/VariationTrials.h"

namespace tacto {

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
    out.prevalenceAll = prevalenceInterval(people, people).low;
    out.prevalenceButOne = prevalenceInterval(people - 1, people).low;
    out.width = intervalWidths(population.accuracies, trials);
    return out;
}

}  // namespace tacto
