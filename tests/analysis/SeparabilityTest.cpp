#include <gtest/gtest.h>

#include "core/analysis/Separability.h"
#include "tests/analysis/SyntheticTrials.h"

namespace tacto::test {
namespace {

// Reference numbers by numpy 1.24 on the same trials, with
//   mu = [X[lab==c].mean(0)]; R = X - mu[lab]; S = R.T @ R / (len(X) - 4)
//   S[0,0] = max(S[0,0], (1e-3*mean amplitude)**2), S[1,1] likewise
//   mahalanobis = sqrt(d @ solve(S, d)), jnd = |log(m1/m2)| / log(1 + w)
// and for the confusion the textbook's discriminant function x'P mu - mu'P mu/2 + ln(1/4) per fold i mod 10.
struct Reference {
    std::size_t a, b;
    double mahalanobis, amplitudeJnd, intervalJnd;
};

void expectPairs(const Separability& found, const std::vector<Reference>& references) {
    ASSERT_EQ(found.pairs.size(), references.size());
    for (std::size_t k = 0; k < references.size(); ++k) {
        EXPECT_EQ(found.pairs[k].a, kFourConditions[references[k].a]);
        EXPECT_EQ(found.pairs[k].b, kFourConditions[references[k].b]);
        EXPECT_NEAR(found.pairs[k].mahalanobis, references[k].mahalanobis, 1e-8 * references[k].mahalanobis);
        EXPECT_NEAR(found.pairs[k].amplitudeJnd, references[k].amplitudeJnd, 1e-9);
        EXPECT_NEAR(found.pairs[k].intervalJnd, references[k].intervalJnd, 1e-9);
    }
}

TEST(Separability, TheFourConditionsAgreeWithNumpy) {
    const auto found = judgeSeparability(trialsOf({})).value();
    expectPairs(found, {{0, 1, 168.425420534, 0.0006932162713, 9.35099293631},
                        {0, 2, 112.719445996, 14.5436932708, 0.00377486649001},
                        {0, 3, 244.87893785, 14.547165023, 9.38098096813},
                        {1, 2, 149.176582479, 14.5430000545, 9.34721806982},
                        {1, 3, 112.827730619, 14.5464718067, 0.0299880318204},
                        {2, 3, 168.571876393, 0.00347175215588, 9.37720610164}});
    for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_EQ(found.conditions[c].name, kFourConditions[c]);
        EXPECT_EQ(found.conditions[c].n, 25U);
        EXPECT_EQ(found.confusion[c][c], 25U);
    }
    EXPECT_NEAR(found.conditions[0].amplitudeVariation, 0.030877146886533032, 1e-12);
    EXPECT_NEAR(found.conditions[3].intervalVariation, 0.02035931811436377, 1e-12);
    EXPECT_EQ(found.folds, 10U);
    EXPECT_EQ(found.accuracy.value, 1);
    EXPECT_NEAR(found.accuracy.low, 0.9630065017930143, 1e-12);
    EXPECT_EQ(found.verdict, Verdict::Pass);
}

TEST(Separability, OverlappingConditionsAgreeWithNumpyTrialByTrial) {
    const auto found = judgeSeparability(trialsOf(overlapping())).value();
    expectPairs(found, {{0, 1, 2.47129235539, 0.533993175933, 0.343131985526},
                        {0, 2, 2.31277310101, 0.943562794831, 0.312243730856},
                        {0, 3, 4.30931351066, 1.44939546113, 0.0675709336288},
                        {1, 2, 2.39397963087, 0.409569618898, 0.655375716381},
                        {1, 3, 2.36514299452, 0.9154022852, 0.275561051897},
                        {2, 3, 2.70416955558, 0.505832666302, 0.379814664484}});
    const std::vector<std::vector<std::size_t>> confusion{{16, 3, 4, 0}, {3, 11, 4, 5}, {3, 4, 13, 3}, {0, 3, 2, 18}};
    EXPECT_EQ(found.confusion, confusion);
    EXPECT_NEAR(found.accuracy.low, 0.5284298907445389, 1e-12);
    EXPECT_NEAR(found.accuracy.high, 0.7219836598766033, 1e-12);
    EXPECT_EQ(found.verdict, Verdict::Fail);
}

TEST(Separability, ANoiselessTwinIsFlooredAtItsUncertaintyAndNotInfinite) {
    TrialDesign design;
    design.amplitudeSd = design.intervalSd_s = 0;
    auto trials = trialsOf(design);
    const auto unstated = judgeSeparability(trials).value();
    EXPECT_NEAR(unstated.amplitudeFloor, 0.001 * 25, 1e-12) << "0.1 % of the pooled mean";
    EXPECT_NEAR(unstated.intervalFloor_s, 0.001 * 1.25, 1e-12);
    EXPECT_NEAR(unstated.pairs[1].mahalanobis, 30 / 0.025, 1e-6);
    EXPECT_NEAR(unstated.pairs[0].mahalanobis, 1.5 / 0.00125, 1e-6);
    EXPECT_EQ(unstated.verdict, Verdict::Pass);

    for (std::size_t i = 0; i < trials.size(); ++i) {
        trials[i].amplitudeUncertainty = i % 2 == 0 ? 0.1 : 0.7;
        trials[i].intervalUncertainty_s = 1e-4;
    }
    const auto stated = judgeSeparability(trials).value();
    EXPECT_NEAR(stated.amplitudeFloor, 0.5, 1e-12) << "root mean square of 0.1 and 0.7";
    EXPECT_NEAR(stated.pairs[1].mahalanobis, 30 / 0.5, 1e-6);
    EXPECT_NEAR(stated.pairs[0].mahalanobis, 1.5 / 1e-4, 1e-3);

    trials[3].amplitudeUncertainty = std::nan("");
    EXPECT_TRUE(std::isnan(judgeSeparability(trials).value().amplitudeFloor)) << "one that is unknown";
    trials[3].amplitudeUncertainty = 0;
    EXPECT_NEAR(judgeSeparability(trials).value().amplitudeFloor, 0.025, 1e-12) << "one that states none";
}

TEST(Separability, IdenticalTrialsOfTwoConditionsAreNotSeparable) {
    RecordProperty("hazard", "H9");
    std::vector<SeparabilityTrial> trials;
    for (int i = 0; i < 50; ++i) {
        trials.push_back({"a", 10, 1, 0, 0});
        trials.push_back({"b", 10, 1, 0, 0});
    }
    const auto found = judgeSeparability(trials).value();
    EXPECT_EQ(found.pairs[0].mahalanobis, 0);
    EXPECT_EQ(found.accuracy.value, 0.5);
    EXPECT_EQ(found.verdict, Verdict::Fail);
}

TEST(Separability, ReadingsInPerfectStepStayFinite) {
    std::vector<SeparabilityTrial> trials;
    for (int i = 0; i < 40; ++i) {
        const double wobble = 0.01 * (i % 5);
        trials.push_back({"a", 10 * (1 + wobble), 1 + wobble, 0, 0});
        trials.push_back({"b", 20 * (1 + wobble), 1 + wobble, 0, 0});
    }
    const auto found = judgeSeparability(trials).value();
    EXPECT_TRUE(std::isfinite(found.pairs[0].mahalanobis));
    EXPECT_EQ(found.accuracy.value, 1);
}

TEST(Separability, AnyTwoOrMoreConditionsWillDo) {
    auto trials = trialsOf({});
    std::erase_if(trials, [](const auto& t) { return t.condition == "smooth-high"; });
    const auto three = judgeSeparability(trials).value();
    EXPECT_EQ(three.conditions.size(), 3U);
    EXPECT_EQ(three.pairs.size(), 3U);
    EXPECT_EQ(three.confusion.size(), 3U);
    std::erase_if(trials, [](const auto& t) { return t.condition != "rough-low"; });
    EXPECT_FALSE(judgeSeparability(trials)) << "one";
    EXPECT_FALSE(judgeSeparability({})) << "none";
}

TEST(Separability, TheOrderOfTheConditionsIsThePapersOrTheOneAsked) {
    auto trials = trialsOf({});
    std::swap(trials[0], trials[3]);
    EXPECT_EQ(judgeSeparability(trials).value().conditions[0].name, "smooth-low");
    const SeparabilityOptions reversed{{"rough-high", "rough-low", "smooth-high", "smooth-low"}};
    EXPECT_EQ(judgeSeparability(trials, reversed).value().conditions[0].name, "rough-high");
    const auto unexpected = judgeSeparability(trials, {{"smooth-low", "rough-high"}});
    ASSERT_FALSE(unexpected);
    EXPECT_EQ(unexpected.error().message, "a trial of condition 'smooth-high'; smooth-low, rough-high were expected");
}

TEST(Separability, RefusesValuesThatNoPulseHas) {
    RecordProperty("hazard", "H9");
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
        auto trials = trialsOf({});
        trials[5].amplitude = bad;
        EXPECT_EQ(judgeSeparability(trials).error().code, ErrorCode::InvalidArgument) << bad;
        trials = trialsOf({});
        trials[5].interval_s = bad;
        EXPECT_EQ(judgeSeparability(trials).error().code, ErrorCode::InvalidArgument) << bad;
    }
    auto unnamed = trialsOf({});
    unnamed[0].condition = "";
    EXPECT_FALSE(judgeSeparability(unnamed));
}

}  // namespace
}  // namespace tacto::test
