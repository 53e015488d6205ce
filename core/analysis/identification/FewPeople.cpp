#include "core/analysis/identification/FewPeople.h"

#include "core/analysis/statistics/Binomial.h"
#include "core/analysis/statistics/Prevalence.h"

namespace tacto {

FewPeople judgeFewPeople(std::vector<PersonResult> people) {
    FewPeople out;
    std::vector<double> accuracies, bits;
    for (const auto& person : people) {
        const auto& figures = person.figures;
        if (figures.n == 0) continue;
        accuracies.push_back(figures.accuracy.value);
        bits.push_back(figures.itCorrected_bits);
        if (figures.pChance < kAboveChanceLevel) ++out.aboveChance;
    }
    out.accuracy = statisticsOf(accuracies);
    out.itCorrected_bits = statisticsOf(bits);
    out.share = clopperPearsonInterval(out.aboveChance, people.size());
    out.prevalence = prevalenceInterval(out.aboveChance, people.size());
    if (!people.empty()) out.prevalenceAtLeast = prevalenceAtLeast(out.aboveChance, people.size());
    out.people = std::move(people);
    return out;
}

std::string fewPeopleSentence(const FewPeople& found) {
    const std::size_t n = found.people.size();
    if (n == 0) return "Nothing is known: the study has no participants.";
    const auto verb = n == 1 ? "was" : "were";
    const auto counted =
        fmt::format("{} of {} {} above chance (p < {:.2f} each; exact 95 % interval {:.0f} to {:.0f} %)",
                    found.aboveChance, n, verb, kAboveChanceLevel, 100 * found.share.low, 100 * found.share.high);
    if (found.aboveChance == n) {
        return fmt::format("{}: at least {:.0f} % of such people can tell them apart (95 %).", counted,
                           100 * found.prevalenceAtLeast);
    }
    return fmt::format("{}: {:.0f} to {:.0f} % of such people can tell them apart (95 %).", counted,
                       100 * found.prevalence.low, 100 * found.prevalence.high);
}

}  // namespace tacto
