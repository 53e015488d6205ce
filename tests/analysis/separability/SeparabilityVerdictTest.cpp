// Unmeasured values never read as passed, and a small mishap is not a failure.
#include <gtest/gtest.h>

#include "core/analysis/separability/Separability.h"
#include "tests/analysis/SyntheticTrials.h"

namespace tacto::test {
namespace {

bool anyReason(const Separability& found, std::string_view part) {
    return std::any_of(found.reasons.begin(), found.reasons.end(),
                       [&](const auto& reason) { return reason.find(part) != std::string::npos; });
}

Separability judged(const TrialDesign& design) { return judgeSeparability(trialsOf(design)).value(); }

TEST(SeparabilityVerdict, FewerThanSeventyThreeTrialsAreIndeterminate) {
    RecordProperty("hazard", "H9");
    TrialDesign design;
    design.repeats = 18;  // 72 trials, all recognised
    const auto few = judged(design);
    EXPECT_EQ(few.accuracy.value, 1);
    EXPECT_EQ(few.verdict, Verdict::Indeterminate);
    EXPECT_TRUE(anyReason(few, "fewer than 73 trials"));
    design.repeats = 19;
    EXPECT_EQ(judged(design).verdict, Verdict::Pass);

    auto seventyThree = trialsOf(design);
    seventyThree.resize(73);
    EXPECT_EQ(judgeSeparability(seventyThree).value().verdict, Verdict::Pass);
    seventyThree.resize(72);
    EXPECT_EQ(judgeSeparability(seventyThree).value().verdict, Verdict::Indeterminate);
}

/// smooth-low and smooth-high differ only in interval. In `errors` trials, the first is closer to the second.
std::vector<SeparabilityTrial> withErrors(std::size_t errors, int repeats) {
    TrialDesign design;
    design.repeats = repeats;
    design.amplitude = {10, 10.01, 40, 40};
    design.interval_s = {0.8, 0.5, 2, 0.5};
    auto trials = trialsOf(design);
    for (std::size_t e = 0; e < errors; ++e) trials[e * 4].interval_s = 0.64;
    return trials;
}

TEST(SeparabilityVerdict, OneErrorInAHundredIsNotAFail) {
    RecordProperty("hazard", "H9");
    const auto found = judgeSeparability(withErrors(1, 25)).value();
    EXPECT_NEAR(found.accuracy.value, 0.99, 1e-12) << "the construction";
    EXPECT_LT(found.accuracy.low, 0.95);
    EXPECT_GT(found.accuracy.high, 0.95);
    for (const auto& reason : found.reasons) {
        EXPECT_EQ(reason.find("the interval lies below 95 %"), std::string::npos) << reason;
    }
    EXPECT_TRUE(anyReason(found, "99.0 % of trials (95 % interval 94.6 to 99.8 %); its lower end is below 95 %"));
}

TEST(SeparabilityVerdict, AccuracyWhoseIntervalLiesBelowNinetyFivePercentFails) {
    const auto found = judged(overlapping());
    EXPECT_EQ(found.verdict, Verdict::Fail);
    EXPECT_TRUE(anyReason(found, "the interval lies below 95 %"));
}

TEST(SeparabilityVerdict, APairBelowFiveJustNoticeableDifferencesFails) {
    TrialDesign design;
    design.interval_s = {1.02, 0.5, 1.02, 0.5};  // ln(2.04)/ln(1.16) = 4.80
    const auto near = judged(design);
    EXPECT_EQ(near.accuracy.value, 1) << "an instrument tells them apart; a person might not";
    EXPECT_EQ(near.verdict, Verdict::Fail);
    EXPECT_TRUE(
        anyReason(near, "smooth-low and smooth-high differ by 0.0 just-noticeable differences in amplitude and 4.8"));
    design.interval_s = {1.06, 0.5, 1.06, 0.5};  // ln(2.12)/ln(1.16) = 5.06
    EXPECT_EQ(judged(design).verdict, Verdict::Pass);
}

TEST(SeparabilityVerdict, AVariationAboveFivePercentFails) {
    TrialDesign design;
    design.amplitudeSd = 0.7;  // 7 % of 10 V
    const auto found = judged(design);
    EXPECT_EQ(found.verdict, Verdict::Fail);
    EXPECT_TRUE(anyReason(found, "The amplitude of smooth-low varies by 7."));
    EXPECT_FALSE(anyReason(found, "The amplitude of rough-low"));
}

TEST(SeparabilityVerdict, TrialsThatWereNotMeasuredForbidAPass) {
    RecordProperty("hazard", "H9");
    for (auto member : {&SeparabilityTrial::amplitude, &SeparabilityTrial::interval_s}) {
        auto trials = trialsOf({});
        trials[17].*member = std::nan("");
        const auto found = judgeSeparability(trials).value();
        EXPECT_EQ(found.verdict, Verdict::Indeterminate);
        EXPECT_EQ(found.conditions[1].notMeasured, 1U);
        EXPECT_EQ(found.conditions[1].n, 24U);
        EXPECT_TRUE(anyReason(found, "1 of 25 trials of smooth-high were not measured."));
    }
}

TEST(SeparabilityVerdict, AMissingConditionForbidsAPass) {
    RecordProperty("hazard", "H9");
    TrialDesign design;
    design.repeats = 40;
    auto trials = trialsOf(design);
    std::erase_if(trials, [](const auto& t) { return t.condition == "rough-high"; });
    const SeparabilityOptions four{{kFourConditions.begin(), kFourConditions.end()}};
    const auto found = judgeSeparability(trials, four).value();
    EXPECT_EQ(found.verdict, Verdict::Indeterminate);
    EXPECT_TRUE(std::isnan(found.pairs[2].mahalanobis));
    EXPECT_TRUE(anyReason(found, "smooth-low and rough-high cannot be compared"));
}

TEST(SeparabilityVerdict, EveryTrialUnmeasuredIsIndeterminate) {
    RecordProperty("hazard", "H9");
    auto trials = trialsOf({});
    for (auto& trial : trials) trial.amplitude = std::nan("");
    const auto found = judgeSeparability(trials).value();
    EXPECT_EQ(found.verdict, Verdict::Indeterminate);
    EXPECT_TRUE(std::isnan(found.accuracy.value));
}

TEST(SeparabilityVerdict, OneTrialPerConditionIsIndeterminate) {
    RecordProperty("hazard", "H9");
    TrialDesign design;
    design.repeats = 1;
    const auto found = judged(design);
    EXPECT_EQ(found.verdict, Verdict::Indeterminate);
    EXPECT_EQ(found.folds, 0U);
    EXPECT_TRUE(std::isnan(found.conditions[0].amplitudeVariation));
    EXPECT_TRUE(anyReason(found, "Too few trials to cross-validate"));
    design.repeats = 2;
    EXPECT_EQ(judged(design).folds, 2U);
    EXPECT_EQ(judged(design).verdict, Verdict::Indeterminate);
}

TEST(SeparabilityVerdict, AFailureStandsBesideWhatIsUndecided) {
    auto trials = trialsOf(overlapping());
    trials[0].amplitude = std::nan("");
    const auto found = judgeSeparability(trials).value();
    EXPECT_EQ(found.verdict, Verdict::Fail);
    EXPECT_TRUE(anyReason(found, "not measured"));
}

}  // namespace
}  // namespace tacto::test
