#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/identification/Identification.h"
#include "core/analysis/identification/IdentificationJson.h"
#include "core/analysis/identification/IdentificationText.h"
#include "tests/support/Figures.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using nlohmann::json;

const std::vector<std::string> kLabels = {"smooth-low", "smooth-high", "rough-low", "rough-high"};

IdentificationTrial trialOf(std::size_t number, std::string condition, std::string response, std::size_t block = 1) {
    IdentificationTrial trial;
    trial.number = number;
    trial.block = block;
    trial.condition = std::move(condition);
    trial.response = std::move(response);
    return trial;
}

std::vector<IdentificationTrial> trialsOf(const json& rows) {
    std::vector<IdentificationTrial> trials;
    for (const auto& row : rows)
        trials.push_back(trialOf(trials.size() + 1, row.at("condition"), row.at("response"), row.at("block")));
    return trials;
}

void expectEstimate(const Estimate& found, const json& expected, const std::string& what) {
    EXPECT_NEAR(found.value, expected.at("value").get<double>(), 1e-9) << what;
    EXPECT_NEAR(found.low, expected.at("low").get<double>(), 1e-9) << what;
    EXPECT_NEAR(found.high, expected.at("high").get<double>(), 1e-9) << what;
}

void expectFigures(const ConfusionFigures& found, const json& expected, const std::string& what) {
    EXPECT_EQ(found.n, expected.at("n").get<std::size_t>()) << what;
    EXPECT_EQ(found.hits, expected.at("hits").get<std::size_t>()) << what;
    expectEstimate(found.accuracy, expected.at("accuracy"), what);
    EXPECT_NEAR(found.pChance / expected.at("p_chance").get<double>(), 1, 1e-9) << what;
    EXPECT_NEAR(found.it_bits, expected.at("it_bits").get<double>(), 1e-12) << what;
    EXPECT_NEAR(found.itCorrected_bits.value, expected.at("it_corrected_bits").get<double>(), 1e-9) << what;
    EXPECT_NEAR(found.itCorrected_bits.low, expected.at("it_corrected_low_bits").get<double>(), 1e-9) << what;
    EXPECT_NEAR(found.itCorrected_bits.high, expected.at("it_corrected_high_bits").get<double>(), 1e-9) << what;
}

void expectFeature(const FeatureFigures& found, const json& expected, const std::string& what) {
    EXPECT_EQ(json(found.values), expected.at("values")) << what;
    EXPECT_EQ(json(found.confusion), expected.at("confusion")) << what;
    expectFigures(found.figures, expected, what);
    EXPECT_NEAR(found.dPrime, expected.at("d_prime").get<double>(), 1e-9) << what;
    EXPECT_NEAR(found.criterion, expected.at("criterion").get<double>(), 1e-9) << what;
}

TEST(Identification, AWholeSessionAgreesWithScipy) {
    RecordProperty("hazard", "H9");
    const auto& expected = test::figuresOf("identification").at("session");
    const auto found = test::accepted(identify(trialsOf(expected.at("trials")), kLabels));
    EXPECT_EQ(json(found.labels), expected.at("labels"));
    EXPECT_EQ(json(found.columns), expected.at("columns"));
    EXPECT_EQ(json(found.confusion), expected.at("confusion"));
    expectFigures(found.all, expected, "all");
    ASSERT_TRUE(found.texture && found.pressure);
    expectFeature(*found.texture, expected.at("texture"), "texture");
    expectFeature(*found.pressure, expected.at("pressure"), "pressure");
    EXPECT_EQ(found.catches.n, 10U);
    EXPECT_EQ(found.catches.falseAlarms, expected.at("catch").at("k").get<std::size_t>());
    expectEstimate(found.catches.rate, expected.at("catch"), "catch");
    expectEstimate(found.learning, expected.at("learning"), "learning");
    EXPECT_EQ(found.afterSame.n, expected.at("sequence").at("same").at("n").get<std::size_t>());
    EXPECT_EQ(found.afterSame.hits, expected.at("sequence").at("same").at("hits").get<std::size_t>());
    EXPECT_EQ(found.afterOther.n, expected.at("sequence").at("other").at("n").get<std::size_t>());
    EXPECT_EQ(found.afterOther.hits, expected.at("sequence").at("other").at("hits").get<std::size_t>());
    for (std::size_t i = 0; i < found.shares.size(); ++i) {
        EXPECT_EQ(found.shares[i].n, expected.at("shares")[i].at("n").get<std::size_t>());
        expectEstimate(found.shares[i].share, expected.at("shares")[i], found.shares[i].response);
    }
    EXPECT_EQ(toJson(found).at("blocks"), expected.at("blocks"));
}

TEST(Identification, JsonHasTheKeysOfTheContract) {
    const auto& session = test::figuresOf("identification").at("session");
    const auto found = test::accepted(identify(trialsOf(session.at("trials")), kLabels));
    const auto shown = toJson(found);
    for (const char* key : {"labels", "columns", "confusion", "texture", "pressure", "catch", "no_answer", "blocks"})
        EXPECT_TRUE(shown.contains(key)) << key;
    for (const char* key : {"n", "hits", "accuracy", "p_chance", "it_bits", "it_bias_bits", "it_corrected_bits",
                            "it_corrected_low_bits", "it_corrected_high_bits"}) {
        EXPECT_TRUE(shown.contains(key)) << key;
        EXPECT_TRUE(shown.at("texture").contains(key)) << key;
    }
    EXPECT_EQ(shown.at("catch").at("false_alarms"), 2);
    EXPECT_NEAR(shown.at("catch").at("rate").at("value").get<double>(), 0.2, 1e-12);
    EXPECT_NEAR(shown.at("it_bias_bits").get<double>(),
                shown.at("it_bits").get<double>() - shown.at("it_corrected_bits").get<double>(), 1e-12);
    EXPECT_EQ(bitsText(correctedBitsFrom(shown)), bitsText(found.all.itCorrected_bits));
    EXPECT_EQ(bitsText(found.all.itCorrected_bits), "0.96 (0.68 to 1.24)");
    EXPECT_EQ(bitsText(correctedBitsFrom({{"it_corrected_bits", 1.1}})), "1.10") << "of a version before the interval";
    EXPECT_EQ(bitsText(correctedBitsFrom(json::object())), "–");
}

TEST(Identification, OnlyAnsweredTestTrialsCount) {
    RecordProperty("hazard", "H9");
    std::vector<IdentificationTrial> trials;
    for (std::size_t i = 0; i < 4; ++i) {
        trials.push_back(trialOf(i + 1, kLabels[i], kLabels[i]));
        trials.back().phase = TrialPhase::Training;
    }
    trials.push_back(trialOf(5, "rough-low", ""));  // interrupted, then answered at the second attempt
    trials.push_back(trialOf(6, "rough-high", ""));
    trials.push_back(trialOf(7, "catch", "none"));
    trials.push_back(trialOf(8, "smooth-low", "not-sure"));
    trials.push_back(trialOf(5, "rough-low", "rough-low"));
    trials.back().attempt = 2;
    const auto found = test::accepted(identify(trials, kLabels));
    EXPECT_EQ(found.all.n, 2U);
    EXPECT_EQ(found.all.hits, 1U);
    EXPECT_EQ(found.noAnswer, 1U);
    EXPECT_EQ(found.catches.n, 1U);
    EXPECT_EQ(found.catches.falseAlarms, 0U);
    EXPECT_EQ(found.confusion[0][5], 1U);
}

TEST(Identification, WithoutTrialsNothingIsKnown) {
    RecordProperty("hazard", "H9");
    const auto found = test::accepted(identify({}, kLabels));
    EXPECT_EQ(found.all.n, 0U);
    EXPECT_EQ(found.all.pChance, 1);
    const auto shown = toJson(found);
    EXPECT_TRUE(shown.at("accuracy").at("value").is_null());
    EXPECT_TRUE(shown.at("it_bits").is_null());
    EXPECT_TRUE(shown.at("it_corrected_bits").is_null());
    EXPECT_TRUE(shown.at("texture").at("d_prime").is_null());
}

TEST(Identification, AllRightIsTwoBitsAndStaysFinite) {
    std::vector<IdentificationTrial> trials;
    for (std::size_t i = 0; i < 80; ++i) trials.push_back(trialOf(i + 1, kLabels[i % 4], kLabels[i % 4], i / 16));
    const auto found = test::accepted(identifyAsMet(trials));
    EXPECT_EQ(found.labels, kLabels);
    EXPECT_NEAR(found.all.it_bits, 2, 1e-12);
    EXPECT_NEAR(found.all.itCorrected_bits.value, 2, 1e-12);
    EXPECT_LT(found.all.itCorrected_bits.low, 1.75);
    EXPECT_NEAR(found.texture->figures.it_bits, 1, 1e-12);
    EXPECT_NEAR(found.texture->dPrime, 2 * 2.2508, 1e-3);  // z(40.5/41) on each side
    EXPECT_NEAR(found.texture->criterion, 0, 1e-12);
    EXPECT_TRUE(std::isnan(found.learning.value));
}

/// pilot.md section 10: `analyze identification` takes the labels in the data as the offered answers.
TEST(Identification, WhatIsMetIsWhatWasOffered) {
    const auto found = test::accepted(identifyAsMet(
        std::vector{trialOf(1, "a", "b"), trialOf(2, "b", "b"), trialOf(3, "a", "none"), trialOf(4, "catch", "none")}));
    EXPECT_EQ(found.labels, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(found.columns, (std::vector<std::string>{"a", "b", "none"}));
    EXPECT_EQ(found.confusion, (std::vector<std::vector<std::size_t>>{{0, 1, 1}, {0, 1, 0}}));
    EXPECT_EQ(found.all.chance, 0.5);
    const auto wider = identifyAsMet(std::vector{trialOf(1, "a", "b"), trialOf(2, "b", "b"), trialOf(3, "a", "c")});
    EXPECT_EQ(wider->labels.size(), 2U);
    EXPECT_NEAR(wider->all.chance, 1.0 / 3, 1e-15);  // c was also a possible guess
}

TEST(Identification, LabelsThatAreNotTwoByTwoHaveNoFeatures) {
    const auto found =
        test::accepted(identifyAsMet(std::vector{trialOf(1, "a", "b"), trialOf(2, "b", "b"), trialOf(3, "c", "none")}));
    EXPECT_FALSE(found.texture);
    EXPECT_TRUE(toJson(found).at("pressure").is_null());
    EXPECT_NEAR(found.all.chance, 1.0 / 3, 1e-15);
}

TEST(Identification, RefusesWhatIsNoAnswer) {
    const auto refusal = [](std::vector<IdentificationTrial> trials, std::vector<std::string> labels = kLabels) {
        const auto found = identify(trials, std::move(labels));
        return found ? std::string("accepted") : found.error().message;
    };
    EXPECT_EQ(refusal({trialOf(3, "rough-high", "rogh-high")}),
              "trial 3 was answered \"rogh-high\"; smooth-low, smooth-high, rough-low, rough-high, none, not-sure was "
              "expected");
    EXPECT_EQ(refusal({trialOf(3, "hard", "rough-high")}),
              "trial 3 presents \"hard\"; smooth-low, smooth-high, rough-low, rough-high or catch was expected");
    EXPECT_EQ(refusal({trialOf(3, "rough-high", "none"), trialOf(3, "rough-high", "rough-high")}),
              "the answer of trial 3 is given twice; once is expected");
    EXPECT_EQ(refusal({}, {"a"}), "1 condition(s); at least two are needed to tell apart");
    EXPECT_EQ(refusal({}, {"a", "b", "a"}), "the condition \"a\" is given twice; once is expected");
    EXPECT_EQ(refusal({}, {"a", "none"}),
              "a condition is named \"none\"; a name other than catch, none and not-sure is accepted");
}

}  // namespace
}  // namespace tacto
