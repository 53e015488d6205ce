#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/separability/Separability.h"
#include "core/analysis/separability/SeparabilityJson.h"
#include "tests/analysis/SyntheticTrials.h"
#include "tests/support/Figures.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

/// Compares with numpy and scipy on the same trials (tests/reference/trials.py).
void expectAgrees(const Separability& found, const nlohmann::json& numpy) {
    const auto& pairs = numpy.at("pairs");
    ASSERT_EQ(found.pairs.size(), pairs.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto mahalanobis = pairs[k].at("mahalanobis").get<double>();
        EXPECT_EQ(found.pairs[k].a, kFourConditions.at(pairs[k].at("a")));
        EXPECT_EQ(found.pairs[k].b, kFourConditions.at(pairs[k].at("b")));
        EXPECT_NEAR(found.pairs[k].mahalanobis, mahalanobis, 1e-8 * mahalanobis);
        EXPECT_NEAR(found.pairs[k].amplitudeJnd, pairs[k].at("amplitude_jnd").get<double>(), 1e-9);
        EXPECT_NEAR(found.pairs[k].intervalJnd, pairs[k].at("interval_jnd").get<double>(), 1e-9);
    }
    for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_EQ(found.conditions[c].name, kFourConditions[c]);
        EXPECT_NEAR(found.conditions[c].amplitudeVariation, numpy.at("amplitude_variation").at(c).get<double>(), 1e-12);
        EXPECT_NEAR(found.conditions[c].intervalVariation, numpy.at("interval_variation").at(c).get<double>(), 1e-12);
    }
    EXPECT_EQ(found.confusion, numpy.at("confusion").get<std::vector<std::vector<std::size_t>>>());
    EXPECT_NEAR(found.accuracy.low, numpy.at("accuracy").at("low").get<double>(), 1e-12);
    EXPECT_NEAR(found.accuracy.high, numpy.at("accuracy").at("high").get<double>(), 1e-12);
}

TEST(Separability, TheFourConditionsAgreeWithNumpy) {
    const auto found = judgeSeparability(trialsOf({})).value();
    expectAgrees(found, figuresOf("trials").at("apart"));
    for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_EQ(found.conditions[c].n, 25U);
        EXPECT_EQ(found.confusion[c][c], 25U);
    }
    EXPECT_EQ(found.folds, 10U);
    EXPECT_EQ(found.accuracy.value, 1);
    EXPECT_EQ(found.verdict, Verdict::Pass);
}

TEST(Separability, OverlappingConditionsAgreeWithNumpyTrialByTrial) {
    const auto found = judgeSeparability(trialsOf(overlapping())).value();
    expectAgrees(found, figuresOf("trials").at("overlapping"));
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
    EXPECT_THAT(judgeSeparability(trials, {{"smooth-low", "rough-high"}}),
                test::refusedSaying(
                    testing::StrEq("a trial of condition 'smooth-high'; smooth-low, rough-high were expected")));
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

TEST(SeparabilityTrial, IsWrittenAsItWasReadAndRefusedWithoutItsCondition) {
    const nlohmann::json row{{"condition", "rough-low"}, {"amplitude_v", 10},       {"interval_s", nullptr},
                             {"amplitude_u_v", 0.1},     {"interval_u_s", nullptr}, {"time_base_u", 1e-5},
                             {"amplitude_gain_u", 3e-3}};
    const auto trial = accepted(separabilityTrialFrom(row));
    EXPECT_TRUE(std::isnan(trial.interval_s));
    EXPECT_EQ(toJson(trial), row);
    const auto bare = accepted(separabilityTrialFrom({{"condition", ""}}));
    EXPECT_TRUE(std::isnan(bare.amplitude));
    EXPECT_FALSE(separabilityTrialFrom({{"amplitude_v", 10}}));
    EXPECT_FALSE(separabilityTrialFrom({{"condition", "rough-low"}, {"amplitude_v", "10"}}));
}

std::string refusal(std::string_view text) {
    const auto trials = parseSeparabilityTrials(text, "t.csv");
    return trials ? "accepted" : trials.error().message;
}

TEST(TrialFile, ReadsColumnsByTheirTrimmedNames) {
    const auto trials = accepted(parseSeparabilityTrials(
        "trial, interval ,condition , amplitude\r\n1,2.0,smooth-low,10.1\r\n\r\n2, .5 ,\"rough, high\",40\r\n",
        "t.csv"));
    ASSERT_EQ(trials.size(), 2U);
    EXPECT_EQ(trials[0].condition, "smooth-low");
    EXPECT_DOUBLE_EQ(trials[0].amplitude, 10.1);
    EXPECT_DOUBLE_EQ(trials[0].interval_s, 2);
    EXPECT_EQ(trials[1].condition, "rough, high");
    EXPECT_DOUBLE_EQ(trials[1].interval_s, 0.5);
}

TEST(TrialFile, ReadsTheNamesOfOurOwnExport) {
    EXPECT_EQ(refusal("condition,amplitude_v,interval_s\na,1,1\n"), "accepted");
}

TEST(TrialFile, AnEmptyValueIsATrialThatWasNotMeasured) {
    RecordProperty("hazard", "H9");
    const auto trials = accepted(parseSeparabilityTrials("condition,amplitude,interval\na,,1\na,1,nan\n", "t.csv"));
    EXPECT_TRUE(std::isnan(trials[0].amplitude));
    EXPECT_TRUE(std::isnan(trials[1].interval_s));
}

TEST(TrialFile, RefusalsNameFileLineAndWhatWasExpected) {
    RecordProperty("hazard", "H10");
    EXPECT_EQ(refusal(""), "t.csv: the file is empty; columns condition, amplitude and interval were expected");
    EXPECT_EQ(refusal("# note\ncondition,amplitude\na,1\n"),
              "t.csv:2: no column 'interval'; columns condition, amplitude and interval were expected");
    EXPECT_EQ(refusal("condition,amplitude,interval\n"),
              "t.csv: nothing after the header line; a row per trial was expected");
    EXPECT_EQ(refusal("condition,amplitude,interval\na,1,1\na,1\n"),
              "t.csv:3: 2 fields; at least 3 were expected, as in the header");
    EXPECT_EQ(refusal("condition,amplitude,interval\n,1,1\n"), "t.csv:2: the condition is empty; a name was expected");
    for (const std::string bad : {"ten", "0", "-4", "inf", "1,5x"}) {
        const auto message = refusal("condition,amplitude,interval\na,1,1\na," + bad + ",1\n");
        EXPECT_EQ(message.find("t.csv:3: "), 0U) << message;
        EXPECT_NE(message.find("a finite number above 0 was expected"), std::string::npos) << message;
    }
}

TEST(TrialFile, AMissingFileIsNamed) {
    const ScratchDir scratch;
    EXPECT_EQ(readSeparabilityTrials(scratch.path() / "none.csv").error().code, ErrorCode::NotFound);
}

}  // namespace
}  // namespace tacto::test
