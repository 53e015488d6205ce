// FewPeople.h - summarises three to five people together, without treating them as a large sample.
//
// Every enrolled person has a row. A person without a usable range is counted as not above chance, because leaving such
// people out would improve the result. Then follow median and range, and how many people were above chance and what
// this says about the population. Answers of different people are never pooled: three people give only ten distinct
// bootstrap samples, and cluster bootstraps need about 24 clusters (Flynn and Peters 2004).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/identification/Identification.h"
#include "core/base/Statistics.h"

namespace tacto {

/// The result of one person with one encoding.
struct PersonResult {
    std::string name;            ///< displayed name: a code in the study, otherwise a label
    bool usable = true;          ///< true if the person had a range between detection and discomfort
    ConfusionFigures figures{};  ///< n = 0 if no test trial was answered
    std::string encoding = {};   ///< with which the answers were given; empty: not stated
};

/// A person who cannot be judged, and why.
struct PersonLeftOut {
    std::string name, reason;
};

struct FewPeople {
    std::vector<PersonResult> people;
    std::vector<PersonLeftOut> leftOut;  ///< people who are not included in any figure
    std::string who = "people";          ///< what the people are called in sentences: "virtual participants"
    Statistics accuracy;                 ///< over the people who answered test trials
    Statistics itCorrected_bits;         ///< over the people who answered test trials
    std::size_t aboveChance = 0;         ///< number of people whose own p is below 0.05
    Estimate share;                      ///< share of all people above chance, Clopper and Pearson 95 %
    Estimate prevalence;                 ///< estimated for the population: prevalenceInterval()
};

[[nodiscard]] FewPeople judgeFewPeople(std::vector<PersonResult> people, std::vector<PersonLeftOut> leftOut = {});

/// Lists each person left out with the reason: "B: 1 condition(s); at least two are needed to tell apart. C: …".
[[nodiscard]] std::string leftOutText(std::span<const PersonLeftOut> leftOut);

/// Returns "4 of 5 were above chance (exact 95 % interval 28 to 99 %), which says that 38 to 98 % of such people can do
/// it.", followed by the people left out, with the reasons.
[[nodiscard]] std::string fewPeopleSentence(const FewPeople& found);

}  // namespace tacto
