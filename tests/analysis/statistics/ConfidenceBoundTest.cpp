// Bounds compared with scipy (tests/reference/estimates.py), and their effect on a verdict.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/separability/Separability.h"
#include "core/analysis/statistics/ConfidenceBound.h"
#include "tests/analysis/SyntheticTrials.h"
#include "tests/support/Figures.h"

namespace tacto::test {
namespace {

TEST(ConfidenceBound, OfAVariationIsExactChiSquared) {
    for (const auto& scipy : figuresOf("estimates").at("variation_factors")) {
        const auto n = scipy.at("n").get<std::size_t>();
        const auto bounds = variationBounds(0.04, n);
        EXPECT_NEAR(bounds.low, 0.04 * scipy.at("low").get<double>(), 1e-8) << n;
        EXPECT_NEAR(bounds.high, 0.04 * scipy.at("high").get<double>(), 1e-7) << n;
    }
    EXPECT_TRUE(std::isnan(variationBounds(0.04, 1).high));
    EXPECT_TRUE(std::isnan(variationBounds(std::nan(""), 25).high));
    EXPECT_TRUE(std::isnan(chiSquaredQuantile(0.5, 0)));
    EXPECT_TRUE(std::isnan(chiSquaredQuantile(1, 4)));
}

TEST(ConfidenceBound, OfADistanceCarriesScatterAndWhatTheInstrumentLeavesOpen) {
    const auto sampleOf = [](const nlohmann::json& made) {
        return MeanReading{made.at(0), made.at(1), made.at(2), made.at(3)};
    };
    // Cases with scatter only, with the instrument's uncertainty, and without scatter.
    for (const auto& scipy : figuresOf("estimates").at("log_ratio")) {
        const auto bounds = logRatioBounds(sampleOf(scipy.at("a")), sampleOf(scipy.at("b")));
        const double tolerance = scipy.at("a").at(1) == 0 ? 1e-12 : 1e-10;  // normal quantile or Student's
        EXPECT_NEAR(bounds.low, scipy.at("low").get<double>(), tolerance) << scipy;
        EXPECT_NEAR(bounds.high, scipy.at("high").get<double>(), tolerance) << scipy;
    }
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
    // Root mean square of 1e-4 · (2 s, 0.5 s), with 3 µs added in quadrature.
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
    design.interval_s = {1.052, 0.5, 1.052, 0.5};  // 5.01 just-noticeable differences
    const auto found = judgeSeparability(stated(design, 0.05, 1e-6, 1e-5)).value();
    EXPECT_GT(found.pairs[0].intervalJnd, 5);
    EXPECT_LT(found.pairs[0].intervalJndBounds.low, 5);
    EXPECT_EQ(found.verdict, Verdict::Indeterminate);
    EXPECT_TRUE(
        says(found, "with 95 % confidence by 0.0 and 5.0 at least; whether 5 in one of them are reached is open"));
    // The instrument's uncertainty of a single interval counts like scatter. An error of the time base or the gain is
    // the same for both conditions and cancels.
    design.interval_s = {1.1, 0.5, 1.1, 0.5};
    EXPECT_EQ(judgeSeparability(stated(design, 0.05, 1e-6, 1e-5)).value().verdict, Verdict::Pass);
    EXPECT_EQ(judgeSeparability(stated(design, 0.05, 0.03, 1e-5)).value().verdict, Verdict::Indeterminate);
    EXPECT_EQ(judgeSeparability(stated(design, 0.05, 1e-6, 0.03)).value().verdict, Verdict::Pass);
    auto trials = stated(design, 0.3, 1e-6, 1e-5);
    const auto whole = judgeSeparability(trials).value().pairs[1].amplitudeJndBounds;
    for (auto& trial : trials) trial.amplitudeGain = 0.8 * trial.amplitudeUncertainty / trial.amplitude;
    const auto rest = judgeSeparability(trials).value().pairs[1].amplitudeJndBounds;
    EXPECT_NEAR(rest.high - rest.low, 0.6 * (whole.high - whole.low), 0.05 * (whole.high - whole.low));
}

TEST(SeparabilityBounds, JudgeTheVariationAndNotItsEstimate) {
    RecordProperty("hazard", "H9");
    TrialDesign design;
    design.amplitudeSd = 0.45;  // 4.6 % of 10 V in 25 trials: the upper bound is 6.1 %
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
