#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/identification/FewPeople.h"
#include "core/analysis/statistics/Estimate.h"

namespace tacto {
namespace {

PersonResult personWith(std::string name, std::size_t hits, std::size_t n) {
    PersonResult person{.name = std::move(name), .usable = n > 0, .figures = {}};
    person.figures.n = n;
    person.figures.hits = hits;
    person.figures.chance = 0.25;
    person.figures.accuracy = wilsonInterval(hits, n);
    person.figures.pChance = binomialAtLeast(hits, n, 0.25);
    person.figures.itCorrected_bits.value = static_cast<double>(hits) / 80;
    return person;
}

TEST(FewPeople, FiveOfFiveMeanAtLeast59PerCent) {
    RecordProperty("hazard", "H9");
    const auto found = judgeFewPeople({personWith("A", 68, 80), personWith("B", 60, 80), personWith("C", 27, 80),
                                       personWith("D", 50, 80), personWith("E", 77, 80)});
    EXPECT_EQ(found.aboveChance, 5U);
    EXPECT_NEAR(found.prevalence.low, 0.59, 0.005);
    EXPECT_NEAR(found.accuracy.median, 0.75, 1e-12);
    EXPECT_NEAR(found.accuracy.min, 27.0 / 80, 1e-12);
    EXPECT_EQ(fewPeopleSentence(found),
              "5 of 5 were above chance (p < 0.05 each; exact 95 % interval 48 to 100 %): at least 59 % of such people "
              "can tell them apart (95 %).");
}

TEST(FewPeople, APersonWithoutAUsableRangeStaysInTheCount) {
    RecordProperty("hazard", "H9");
    const auto found = judgeFewPeople({personWith("A", 68, 80), personWith("B", 60, 80), personWith("C", 0, 0),
                                       personWith("D", 50, 80), personWith("E", 77, 80)});
    EXPECT_EQ(found.aboveChance, 4U);
    EXPECT_EQ(found.people.size(), 5U);
    EXPECT_NEAR(found.prevalence.low, 0.38, 0.005);
    EXPECT_NEAR(found.prevalence.high, 0.98, 0.005);
    EXPECT_EQ(found.accuracy.n, 4U);
    EXPECT_EQ(fewPeopleSentence(found),
              "4 of 5 were above chance (p < 0.05 each; exact 95 % interval 28 to 99 %): 38 to 98 % of such people can "
              "tell them apart (95 %).");
}

TEST(FewPeople, WhoIsLeftOutIsNamedAndCountsNowhere) {
    RecordProperty("hazard", "H9");
    const auto found = judgeFewPeople({personWith("A", 68, 80)}, {{"B", "one trial"}, {"", "none"}});
    EXPECT_EQ(found.people.size(), 1U);
    EXPECT_EQ(found.aboveChance, 1U);
    const auto sentence = fewPeopleSentence(found);
    EXPECT_TRUE(sentence.starts_with("1 of 1 was above chance")) << sentence;
    EXPECT_TRUE(sentence.ends_with("2 of 3 participants were left out: B: one trial. without a name: none."))
        << sentence;
}

TEST(FewPeople, NobodyAboveChanceIsAtLeastNobody) {
    RecordProperty("hazard", "H9");
    const auto found = judgeFewPeople({personWith("A", 20, 80), personWith("B", 19, 80), personWith("C", 22, 80)});
    EXPECT_EQ(found.aboveChance, 0U);
    EXPECT_EQ(found.prevalence.low, 0);
    EXPECT_NE(fewPeopleSentence(found).find("0 of 3 were above chance"), std::string::npos);
    EXPECT_NE(fewPeopleSentence(found).find(": 0 to "), std::string::npos) << fewPeopleSentence(found);
}

TEST(FewPeople, TwentySixOf80IsNotAboveChanceAnd27Is) {
    EXPECT_EQ(judgeFewPeople({personWith("A", 26, 80)}).aboveChance, 0U);
    EXPECT_EQ(judgeFewPeople({personWith("A", 27, 80)}).aboveChance, 1U);
}

TEST(FewPeople, WithoutPeopleNothingIsKnown) {
    RecordProperty("hazard", "H9");
    const auto found = judgeFewPeople({});
    EXPECT_TRUE(std::isnan(found.prevalence.value));
    EXPECT_TRUE(std::isnan(found.accuracy.median));
    EXPECT_EQ(fewPeopleSentence(found), "Nothing is known: no participant has a session with test trials.");
}

}  // namespace
}  // namespace tacto
