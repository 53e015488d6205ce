// Bounds against scipy:
//   np.sqrt((n-1)/stats.chi2.ppf([.95,.05],n-1))
//   c = [(s/m)**2/n], v = sum(c)+sum((u/m)**2), f = v**2/sum(c**2/(n-1)), |ln(m1/m2)| ± stats.t.ppf(.95,f)*sqrt(v)
#include <gtest/gtest.h>

#include "core/analysis/ConfidenceBound.h"
#include "core/analysis/Separability.h"
#include "tests/analysis/SyntheticTrials.h"

namespace tacto::test {
namespace {

TEST(ConfidenceBound, OfAVariationIsExactChiSquared) {
    const struct {
        std::size_t n;
        double low, high;
    } factors[] = {{2, 0.51021346, 15.9472394},
                   {5, 0.64930517, 2.37235569},
                   {25, 0.81183037, 1.31645321},
                   {100, 0.89632971, 1.13355243}};
    for (const auto& expected : factors) {
        const auto bounds = variationBounds(0.04, expected.n);
        EXPECT_NEAR(bounds.low, 0.04 * expected.low, 1e-8) << expected.n;
        EXPECT_NEAR(bounds.high, 0.04 * expected.high, 1e-7) << expected.n;
    }
    EXPECT_TRUE(std::isnan(variationBounds(0.04, 1).high));
    EXPECT_TRUE(std::isnan(variationBounds(std::nan(""), 25).high));
    EXPECT_TRUE(std::isnan(chiSquaredQuantile(0.5, 0)));
    EXPECT_TRUE(std::isnan(chiSquaredQuantile(1, 4)));
}

TEST(ConfidenceBound, OfADistanceCarriesScatterAndWhatTheInstrumentLeavesOpen) {
    const auto scatter = logRatioBounds({10, 0.3, 25, 0}, {40, 0.8, 25, 0});
    EXPECT_NEAR(scatter.low, 1.374164416205488, 1e-10);
    EXPECT_NEAR(scatter.high, 1.3984243060342931, 1e-10);
    const auto both = logRatioBounds({10, 0.3, 4, 0.1}, {12, 0.8, 7, 0.2});
    EXPECT_NEAR(both.low, 0.12135605202957381, 1e-10);
    EXPECT_NEAR(both.high, 0.24328706155833538, 1e-10);
    // Nothing scatters: the normal quantile times the instrument's uncertainty.
    EXPECT_NEAR(logRatioBounds({10, 0, 25, 0.1}, {40, 0, 25, 0}).low, std::log(4) - 1.6448536269514722 * 0.01, 1e-12);
    EXPECT_EQ(logRatioBounds({10, 1, 3, 0}, {10.1, 1, 3, 0}).low, 0);
    EXPECT_TRUE(std::isnan(logRatioBounds({10, 1, 1, 0}, {40, 1, 25, 0}).low));
    EXPECT_TRUE(std::isnan(logRatioBounds({10, 1, 25, std::nan("")}, {40, 1, 25, 0.1}).low));
}

std::vector<SeparabilityTrial> stated(TrialDesign design, double amplitude, double interval_s, double timeBase) {
    auto trials = trialsOf(design);
    for (auto& trial : trials) {
        trial.amplitudeUncertainty = amplitude;
        trial.intervalUncertainty_s = interval_s;
        trial.timeBase = timeBase;
    }
    return trials;
}

bool says(const Separability& found, std::string_view part) {
    return std::ranges::any_of(found.reasons,
                               [&](const auto& reason) { return reason.find(part) != std::string::npos; });
}

TEST(SeparabilityFloor, HoldsTheTimeBaseSoThatNoDistanceExceedsIt) {
    RecordProperty("hazard", "H9");
    TrialDesign still;
    still.amplitudeSd = still.intervalSd_s = 0;
    const auto found = judgeSeparability(stated(still, 0.1, 3e-6, 1e-4)).value();
    // Root mean square of 1e-4 · (2 s, 0.5 s) and 3 µs.
    const double floor = std::sqrt((4e-8 + 0.25e-8) / 2 + 9e-12);
    EXPECT_NEAR(found.intervalFloor_s, floor, 1e-12);
    EXPECT_NEAR(found.pairs[0].mahalanobis, 1.5 / floor, 1e-6);
    EXPECT_LT(found.pairs[0].mahalanobis, 11'000) << "3 µs alone would make it 500000";
    EXPECT_EQ(found.verdict, Verdict::Pass);
}

TEST(SeparabilityFloor, UnknownUncertaintyForbidsAPassAndADistance) {
    RecordProperty("hazard", "H9");
    const double unknown = std::nan("");
    for (const auto& trials :
         {stated({}, unknown, 3e-6, 1e-5), stated({}, 0.1, unknown, 1e-5), stated({}, 0.1, 3e-6, unknown)}) {
        const auto found = judgeSeparability(trials).value();
        EXPECT_EQ(found.verdict, Verdict::Indeterminate);
        EXPECT_TRUE(says(found, "is unknown: the oscilloscope does not state it"));
        for (const auto& pair : found.pairs) EXPECT_TRUE(std::isnan(pair.mahalanobis));
        EXPECT_EQ(found.accuracy.value, 1) << "trials are still classified";
    }
    auto one = stated({}, 0.1, 3e-6, 1e-5);
    one[17].timeBase = unknown;
    EXPECT_EQ(judgeSeparability(one).value().verdict, Verdict::Indeterminate) << "one trial is enough";
}

TEST(SeparabilityBounds, JudgeThePairAndNotItsEstimate) {
    RecordProperty("hazard", "H9");
    TrialDesign design;
    design.interval_s = {1.052, 0.5, 1.052, 0.5};  // 5.01 differences
    const auto found = judgeSeparability(stated(design, 0.05, 1e-6, 1e-5)).value();
    EXPECT_GT(found.pairs[0].intervalJnd, 5);
    EXPECT_LT(found.pairs[0].intervalJndBounds.low, 5);
    EXPECT_EQ(found.verdict, Verdict::Indeterminate);
    EXPECT_TRUE(
        says(found, "with 95 % confidence by 0.0 and 5.0 at least; whether 5 in one of them are reached is open"));
    // What the instrument leaves open counts as much as scatter.
    design.interval_s = {1.1, 0.5, 1.1, 0.5};
    EXPECT_EQ(judgeSeparability(stated(design, 0.05, 1e-6, 1e-5)).value().verdict, Verdict::Pass);
    EXPECT_EQ(judgeSeparability(stated(design, 0.05, 1e-6, 0.03)).value().verdict, Verdict::Indeterminate);
}

TEST(SeparabilityBounds, JudgeTheVariationAndNotItsEstimate) {
    RecordProperty("hazard", "H9");
    TrialDesign design;
    design.amplitudeSd = 0.45;  // 4.6 % of 10 V in 25 trials: up to 6.1 %
    const auto found = judgeSeparability(stated(design, 0.05, 1e-6, 1e-5)).value();
    EXPECT_LT(found.conditions[0].amplitudeVariation, 0.05);
    EXPECT_GT(found.conditions[0].amplitudeVariationBounds.high, 0.05);
    EXPECT_EQ(found.verdict, Verdict::Indeterminate);
    EXPECT_TRUE(says(found, "The amplitude of smooth-low varies by 4."));
    design.repeats = 400;
    EXPECT_EQ(judgeSeparability(stated(design, 0.05, 1e-6, 1e-5)).value().verdict, Verdict::Pass) << "more trials tell";
}

}  // namespace
}  // namespace tacto::test
