#include "core/analysis/identification/FewPeople.h"

#include "core/analysis/statistics/Estimate.h"

namespace tacto {

FewPeople judgeFewPeople(std::vector<PersonResult> people, std::vector<PersonLeftOut> leftOut) {
    FewPeople out;
    std::vector<double> accuracies, bits;
    for (const auto& person : people) {
        const auto& figures = person.figures;
        if (figures.n == 0) continue;
        accuracies.push_back(figures.accuracy.value);
        bits.push_back(figures.itCorrected_bits.value);
        if (figures.pChance < kAboveChanceLevel) ++out.aboveChance;
    }
    out.accuracy = statisticsOf(accuracies);
    out.itCorrected_bits = statisticsOf(bits);
    out.share = clopperPearsonInterval(out.aboveChance, people.size());
    out.prevalence = prevalenceInterval(out.aboveChance, people.size());
    out.people = std::move(people);
    out.leftOut = std::move(leftOut);
    return out;
}

std::string leftOutText(std::span<const PersonLeftOut> leftOut) {
    std::string text;
    for (const auto& person : leftOut) {
        text += fmt::format("{}{}: {}.", text.empty() ? "" : " ", person.name.empty() ? "without a name" : person.name,
                            person.reason);
    }
    return text;
}

std::string fewPeopleSentence(const FewPeople& found) {
    const std::size_t n = found.people.size(), left = found.leftOut.size();
    if (n + left == 0) return "Nothing is known: no participant has a session with test trials.";
    auto text = fmt::format(
        "{} of {} {} above chance (p < {:.2f} each; exact 95 % interval {:.0f} to {:.0f} %): ", found.aboveChance, n,
        n == 1 ? "was" : "were", kAboveChanceLevel, 100 * found.share.low, 100 * found.share.high);
    text += found.aboveChance == n
                ? fmt::format("at least {:.0f} %", 100 * found.prevalence.low)
                : fmt::format("{:.0f} to {:.0f} %", 100 * found.prevalence.low, 100 * found.prevalence.high);
    text += fmt::format(" of such {} can tell them apart (95 %).", found.who);
    if (left > 0) {
        text += fmt::format(" {} of {} participants {} left out: {}", left, n + left, left == 1 ? "was" : "were",
                            leftOutText(found.leftOut));
    }
    return text;
}

}  // namespace tacto
