// FewPeople.h - what three to five people show together, without pretending that they are many.
//
// Every enrolled person has a row: a person without a usable range is one who was not
// above chance, since dropping them would flatter the answer. Then the median and the range, then how many were above
// chance with what that says of everybody. Answers are never pooled over people: three people give ten distinct
// bootstrap samples, and bootstraps over clusters want some 24 (Flynn and Peters 2004).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/identification/Identification.h"
#include "core/base/Statistics.h"

namespace tacto {

/// One person and one encoding.
struct PersonResult {
    std::string name;            ///< the shown name: a code in the study, a label outside it
    bool usable = true;          ///< had a range between detection and discomfort
    ConfusionFigures figures{};  ///< n = 0 where no test trial was answered
};

/// A person who cannot be judged, and why.
struct PersonLeftOut {
    std::string name, reason;
};

struct FewPeople {
    std::vector<PersonResult> people;
    std::vector<PersonLeftOut> leftOut;  ///< people who stand in none of the figures
    std::string who = "people";          ///< whom this speaks of: "virtual participants"
    Statistics accuracy;                 ///< over those who answered test trials
    Statistics itCorrected_bits;         ///< over those who answered test trials
    std::size_t aboveChance = 0;         ///< p < 0.05 each by themselves
    Estimate share;                      ///< above chance of all people, Clopper and Pearson 95 %
    Estimate prevalence;                 ///< over everybody: prevalenceInterval()
};

[[nodiscard]] FewPeople judgeFewPeople(std::vector<PersonResult> people, std::vector<PersonLeftOut> leftOut = {});

/// "B: 1 condition(s); at least two are needed to tell apart. C: …": each person left out, with the reason.
[[nodiscard]] std::string leftOutText(std::span<const PersonLeftOut> leftOut);

/// "4 of 5 were above chance (exact 95 % interval 28 to 99 %), which says that 38 to 98 % of such people can do it.";
/// then how many were left out, who and why.
[[nodiscard]] std::string fewPeopleSentence(const FewPeople& found);

}  // namespace tacto
