#include <cmath>
#include <gtest/gtest.h>

#include "core/base/JsonText.h"
#include "core/pilot/PilotRecord.h"
#include "core/sharing/results/StudyResults.h"

namespace tacto {
namespace {

using nlohmann::json;

SessionRow rowOf(const char* kind, const std::string& name, json body = json::object()) {
    body["name"] = name;
    SessionRow made;
    made.name = kind;
    made.body = *parseJson(dumpJson(body), name);  // as read back from a file
    return made;
}

SessionRow testTrial(std::size_t number, std::size_t block, const std::string& condition, const json& response) {
    return rowOf(response.is_null() ? row::kNoAnswer : row::kAnswer, fmt::format("test {}", number),
                 {{"number", number},
                  {"phase", "test"},
                  {"block", block},
                  {"condition", condition},
                  {"attempt", 1},
                  {"current_ma", condition == "catch" ? 0 : 4.5},
                  {"interval_s", 0.5},
                  {"trains", condition == "catch" ? 0 : 9},
                  {"response", response},
                  {"rt_s", response.is_null() ? json(nullptr) : json(0.75)}});
}

const std::vector<std::string> kLabels = {"smooth-low", "smooth-high", "rough-low", "rough-high"};

TEST(SessionResults, ARangeThatIsNotUsableSaysWhy) {
    RecordProperty("hazard", "H9");
    const auto found = [](const json& range) {
        return sessionResults({rowOf(row::kPlan, "plan", {{"encoding", "standard"}, {"trials", json::array()}}),
                               rowOf(row::kRange, "range", range)},
                              kLabels);
    };
    EXPECT_TRUE(hasUsableRange(found({{"usable", true}, {"min_ma", 3.5}, {"max_ma", 6.5}})));
    const auto narrow = found({{"usable", false}, {"reason", "one step"}, {"min_ma", 4}, {"max_ma", 4.5}});
    EXPECT_FALSE(hasUsableRange(narrow));
    EXPECT_EQ(narrow.rangeNotUsable, "one step");
    EXPECT_FALSE(hasUsableRange(found({{"usable", false}, {"reason", nullptr}, {"min_ma", 4}, {"max_ma", 6}})));
    EXPECT_FALSE(hasUsableRange(found({{"usable", false}, {"reason", "one"}, {"min_intensity", 0.4}})));
    EXPECT_FALSE(hasUsableRange({})) << "none was looked for";
}

TEST(SessionResults, WhatWasMeasuredLastStandsBesideEachTrial) {
    const auto found = sessionResults(
        {rowOf(row::kPlan, "plan", {{"seed", 7}, {"encoding", "swapped"}, {"trials", json::array()}}),
         rowOf(row::kImpedance, "part 1 first", {{"impedance_ohm", 3000}}),
         rowOf(row::kEstimate, "detection", {{"estimate", {{"value", 2.5}, {"low", 2}, {"high", 3}}}}),
         rowOf(row::kRange, "range", {{"usable", true}, {"min_ma", 3.5}, {"max_ma", 6.5}}),
         testTrial(41, 1, "rough-high", "rough-high"),
         rowOf(row::kDrift, "block 2", {{"block", 2}, {"detection_ma", {{"value", 2.9}}}, {"adapted", true}}),
         rowOf(row::kImpedance, "block 2", {{"impedance_ohm", 3400}}), testTrial(61, 2, "catch", "none"),
         testTrial(62, 2, "smooth-low", "not-sure")},
        kLabels);
    EXPECT_EQ(found.encoding, "swapped");
    EXPECT_EQ(found.impedance.value(), 3000);
    EXPECT_EQ(found.detection, 2.5);
    EXPECT_EQ(found.detectionLow, 2);
    EXPECT_EQ(found.detectionHigh, 3);
    EXPECT_EQ(found.low.value(), 3.5);
    EXPECT_EQ(found.high.value(), 6.5);
    ASSERT_EQ(found.trials.size(), 3U);
    EXPECT_EQ(found.trials[0].detection, 2.5);
    EXPECT_NEAR(found.trials[0].voltage.value(), 4.5 * 3, 1e-12);
    EXPECT_FALSE(found.trials[0].adapted);
    EXPECT_EQ(found.trials[2].detection, 2.9);
    EXPECT_EQ(found.trials[2].impedance.value(), 3400);
    EXPECT_TRUE(found.trials[2].adapted);
    EXPECT_EQ(found.trials[2].trial.response, "not-sure");
    ASSERT_EQ(found.drift.size(), 1U);
    EXPECT_EQ(found.drift[0].block, 2U);
    EXPECT_EQ(found.drift[0].detection, 2.9);
    EXPECT_TRUE(found.drift[0].adapted);
}

TEST(SessionResults, ATrialAskedTwiceIsOneTrial) {
    const auto answered =
        sessionResults({testTrial(5, 1, "rough-low", nullptr), testTrial(5, 1, "rough-low", "none")}, kLabels);
    ASSERT_EQ(answered.trials.size(), 1U);
    EXPECT_EQ(answered.trials[0].trial.response, "none");
    const auto silent =
        sessionResults({testTrial(5, 1, "rough-low", nullptr), testTrial(5, 1, "rough-low", nullptr)}, kLabels);
    ASSERT_EQ(silent.trials.size(), 1U);
    EXPECT_EQ(silent.trials[0].trial.response, "");
}

TEST(SessionResults, ATooStrongThatWasTakenBackIsNoCeiling) {
    for (const bool slip : {true, false}) {
        const auto found = sessionResults(
            {rowOf(row::kAnswer, "ascending 1", {{"series", 1}, {"current_ma", 8}, {"response", "too-strong"}}),
             rowOf(row::kAnswer, "ascending 2", {{"series", 2}, {"current_ma", 1}, {"response", "too-strong"}}),
             rowOf(row::kPhase, row::meantName("ascending 2").c_str(), {{"key", slip ? "no" : "yes"}})},
            kLabels);
        EXPECT_EQ(found.tooStrong, slip ? 8 : 1);
        EXPECT_TRUE(found.saidTooStrong);
    }
}

TEST(SessionResults, TrialsOfEachMeasurementOfTheRangeAreToldApart) {
    RecordProperty("hazard", "H9");
    const auto answered = [](const char* name, const char* said) {
        return rowOf(row::kAnswer, name, {{"right", "first"}, {"current_ma", 2}, {"response", said}});
    };
    std::vector<SessionRow> rows{answered("detection 1", "first"),
                                 rowOf(row::kEstimate, "detection", {{"estimate", {{"value", 2.5}}}}),
                                 rowOf(row::kPhase, "measure again 1", {{"key", "yes"}}),
                                 answered("detection 2", "second"),
                                 answered("detection 3", "first"),
                                 rowOf(row::kEstimate, "detection 2", {{"estimate", {{"value", 3.5}}}}),
                                 rowOf(row::kPhase, "measure again 2", {{"key", "no"}})};
    const auto found = sessionResults(rows, kLabels);
    EXPECT_EQ(found.measurements, 2U);
    EXPECT_EQ(found.detection, 3.5);
    ASSERT_EQ(found.thresholds.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(found.thresholds[i].measurement, i == 0 ? 1U : 2U);
    rows.push_back(rowOf(row::kPhase, "measure again 2", {{"key", "yes"}}));
    const auto broken = sessionResults(rows, kLabels);
    EXPECT_EQ(broken.measurements, 3U);
    EXPECT_TRUE(std::isnan(broken.detection)) << "nothing was measured since";
}

TEST(SessionResults, ThresholdsKeepTheirProcedures) {
    const auto found = sessionResults(
        {rowOf(row::kAnswer, "ascending 1", {{"series", 1}, {"current_ma", 4}, {"response", "strong"}, {"rt_s", 1}}),
         rowOf(row::kAnswer, "ascending 2", {{"series", 1}, {"current_ma", 0}, {"response", "too-strong"}}),
         rowOf(row::kAnswer, "ascending 3", {{"series", 2}, {"current_ma", 9}, {"response", "too-strong"}}),
         rowOf(row::kAnswer, "detection 12", {{"right", "second"}, {"current_ma", 2}, {"response", "first"}}),
         rowOf(row::kAnswer, "drift 3.2", {{"right", "first"}, {"current_ma", 2}, {"response", "first"}}),
         rowOf(row::kAnswer, "comparison 7",
               {{"right", "first"}, {"current_ma", 6}, {"weaker_ma", 5}, {"response", "first"}}),
         rowOf(row::kEstimate, "comparison", {{"amplitude_weber", {{"value", 0.12}}}, {"trials", 40}}),
         rowOf(row::kAnswer, "range 1", {{"current_ma", 6}, {"response", "yes"}}),
         rowOf(row::kAnswer, "rating rough-high", {{"condition", "rough-high"}, {"current_ma", 6}}),
         rowOf(row::kAnswer, "test 4 again", {{"of", 4}, {"current_ma", 6}})},
        kLabels);
    ASSERT_EQ(found.thresholds.size(), 7U);
    EXPECT_EQ(found.thresholds[0].procedure, "ascending");
    EXPECT_EQ(found.thresholds[0].type, "stimulus");
    EXPECT_EQ(found.thresholds[1].type, "catch");
    EXPECT_EQ(found.tooStrong, 4);  // an empty presentation is counted with the previous level
    EXPECT_EQ(found.thresholds[3].number, 12U);
    EXPECT_EQ(found.thresholds[3].correct, false);
    EXPECT_EQ(found.thresholds[4].procedure, "drift");
    EXPECT_EQ(found.thresholds[4].series, 3U);
    EXPECT_EQ(found.thresholds[4].number, 2U);
    EXPECT_EQ(found.thresholds[5].procedure, "comparison");
    EXPECT_EQ(found.thresholds[5].number, 7U);
    EXPECT_EQ(found.thresholds[5].type, "first");
    EXPECT_EQ(found.thresholds[5].current.value(), 6);
    EXPECT_EQ(found.thresholds[5].weaker, 5);
    EXPECT_EQ(found.thresholds[5].correct, true);
    EXPECT_EQ(found.amplitudeWeber, 0.12);
    EXPECT_TRUE(std::isnan(found.detection)) << "a Weber fraction is not a threshold";
    EXPECT_EQ(found.thresholds[4].correct, true);
    EXPECT_EQ(found.thresholds[6].correct, std::nullopt);
    EXPECT_TRUE(found.trials.empty());
}

TEST(SessionResults, AnEstimateAtTheEdgeOfWhatWasConsideredIsNoFigure) {
    RecordProperty("hazard", "H9");
    const auto first =
        rowOf(row::kEstimate, "comparison", {{"amplitude_weber", {{"value", 0.12}}}, {"at_edge", false}});
    const auto guessed =
        rowOf(row::kEstimate, "comparison", {{"amplitude_weber", {{"value", 0.97}}}, {"at_edge", true}});
    EXPECT_EQ(sessionResults({first}, kLabels).amplitudeWeber, 0.12);
    EXPECT_TRUE(std::isnan(sessionResults({guessed}, kLabels).amplitudeWeber));
    const auto detected = [](bool atEdge) {
        return sessionResults(
            {rowOf(row::kEstimate, "detection",
                   {{"estimate", {{"value", 2.5}, {"low", 2.4}, {"high", 2.6}}}, {"at_edge", atEdge}}),
             testTrial(41, 1, "rough-high", "rough-high")},
            kLabels);
    };
    EXPECT_EQ(detected(false).detection, 2.5);
    const auto beyond = detected(true);
    for (const double figure :
         {beyond.detection, beyond.detectionLow, beyond.detectionHigh, beyond.trials[0].detection})
        EXPECT_TRUE(std::isnan(figure));
}

TEST(SessionResults, QuestionsBecomeRatingsSideEffectsAndSkin) {
    const auto found = sessionResults(
        {rowOf(row::kSkin, "before erythema", {{"key", "0"}}), rowOf(row::kSkin, "before oedema", {{"key", "1"}}),
         rowOf(row::kSkin, "break 3 erythema", {{"key", "4"}}), rowOf(row::kSkin, "after erythema", {{"key", "2"}}),
         rowOf(row::kRating, "rough-high intensity", {{"value", 7}}),
         rowOf(row::kRating, "rough-high naturalness", {{"key", "rather-unnatural"}}),
         rowOf(row::kRating, "rough-high qualities", {{"keys", {"tapping", "touch"}}}),
         rowOf(row::kRating, "encodings easier", {{"key", "swapped"}}),
         rowOf(row::kSideEffect, "after", {{"keys", {"tingling", "mood"}}}),
         rowOf(row::kSideEffect, "after tingling severity", {{"value", 2}}),
         rowOf(row::kSideEffect, "after tingling relation", {{"value", 5}})},
        kLabels);
    EXPECT_EQ(found.skinBefore, 1);
    EXPECT_EQ(found.skinAfter, 2);
    ASSERT_EQ(found.ratings.size(), 4U);
    EXPECT_EQ(found.ratings[3].condition, "");
    EXPECT_EQ(found.ratings[3].item, "easier");
    EXPECT_EQ(found.ratings[3].value, "swapped");
    EXPECT_EQ(found.ratings[0].condition, "rough-high");
    EXPECT_EQ(found.ratings[0].item, "intensity");
    EXPECT_EQ(found.ratings[0].value, "7");
    EXPECT_EQ(found.ratings[1].value, "rather-unnatural");
    EXPECT_EQ(found.ratings[2].value, "tapping,touch");
    ASSERT_EQ(found.sideEffects.size(), 2U);
    EXPECT_EQ(found.sideEffects[0].severity, 2);
    EXPECT_EQ(found.sideEffects[0].relation, 5);
    EXPECT_EQ(found.sideEffects[1].severity, std::nullopt);
}

TEST(SessionResults, ExposureIsOfEveryTrainThatWasDelivered) {
    const json train{{"amplitude_ma", 5}, {"width_s", 200e-6}, {"pulses", 2}, {"interval_s", 0.5}};
    auto unknown = train;
    unknown["amplitude_ma"] = nullptr;
    const auto found =
        exposureOf({rowOf("delivered", "", train), rowOf("delivered", "", train), rowOf("impedance check", "", train),
                    rowOf("failed", "", train), rowOf("delivered", "", unknown)});
    EXPECT_EQ(found.trains, 3U);
    EXPECT_NEAR(found.stimulated_s, 1.5, 1e-12);
    EXPECT_NEAR(found.charge_uC, 2 * 5 * 0.2 * 2, 1e-9);
}

TEST(SessionResults, WhatLeavesAStudyHasItsLicenseAndItsSecretLabels) {
    RecordProperty("hazard", "H11");
    StudyRecord study;
    study.settings.id = "0123456789abcdef";
    study.settings.license = "CC-BY-4.0";
    study.settings.participantsMax = 9;
    study.labelSeed = 4711;
    study.places = 5;
    const auto shared = sharedStudy(study);
    EXPECT_EQ(shared.license, "CC-BY-4.0");
    EXPECT_EQ(shared.labelSeed, 4711U);
    EXPECT_EQ(shared.places, 5U);
}

TEST(SessionResults, OnlyWhoConsentedAndHadASessionLeavesAStudy) {
    RecordProperty("hazard", "H11");
    StudyRecord study;
    study.settings.participantsMax = 16;
    std::size_t leaving = 0;
    for (int i = 0; i < 16; ++i) {
        ParticipantRecord one;
        one.about.enrolled = i + 1;
        if ((i & 1) != 0) one.about.consents = {{"2", {}, "KL"}};
        if ((i & 2) != 0) one.sessions.emplace_back().about.opened = (i & 4) != 0;
        if ((i & 8) != 0) one.about.state = ParticipantState::Left;
        leaving += (i & 7) == 7;
        study.participants.push_back(one);
    }
    study.participants[15].about.state = ParticipantState::Withdrawn;
    const auto shared = sharedStudy(study);
    ASSERT_EQ(shared.participants.size(), leaving - 1);
    EXPECT_EQ(shared.participants.front().enrolled, 8U) << "with consent, and with a session that began";
    EXPECT_EQ(shared.waiting, 14U);
}

TEST(SessionResults, NoRowsSayNothing) {
    RecordProperty("hazard", "H9");
    const auto found = sessionResults({}, kLabels);
    EXPECT_TRUE(std::isnan(found.detection));
    EXPECT_TRUE(std::isnan(found.low.value()));
    EXPECT_FALSE(found.skinBefore);
    EXPECT_TRUE(found.trials.empty());
}

TEST(SessionResults, OfAMassagerAreIntensitiesAndWhatItsMotorDid) {
    const auto ascending = [](int number, double intensity, const char* response) {
        return rowOf(row::kAnswer, fmt::format("ascending {}", number),
                     {{"series", 1}, {"intensity", intensity}, {"response", response}, {"rt_s", 0.5}});
    };
    const auto found = sessionResults(
        {ascending(1, 0, "nothing"), ascending(2, 0.65, "strong"), ascending(3, 0.7, "too-strong"),
         rowOf(row::kEstimate, "detection", {{"estimate", {{"value", 0.22}}}}),
         rowOf(row::kRange, "range", {{"usable", true}, {"min_intensity", 0.3}, {"max_intensity", 0.55}}),
         rowOf(row::kDrift, "block 2", {{"block", 2}, {"detection_intensity", {{"value", 0.24}}}}),
         rowOf(row::kAnswer, "test 41",
               {{"number", 41},
                {"phase", "test"},
                {"block", 1},
                {"condition", "rough-high"},
                {"intensity", 0.55},
                {"response", "rough-high"},
                {"vibration", {{"bursts", 9}, {"moved", 9}, {"strength_m_s2", 2.5}}}})},
        kLabels);
    EXPECT_EQ(found.tooStrong, 0.7);
    EXPECT_EQ(found.detection, 0.22);
    EXPECT_EQ(found.lowIntensity, 0.3);
    EXPECT_TRUE(std::isnan(found.low.value()));
    ASSERT_EQ(found.drift.size(), 1U);
    EXPECT_EQ(found.drift[0].detection, 0.24);
    ASSERT_EQ(found.trials.size(), 1U);
    EXPECT_EQ(found.trials[0].detection, 0.24);
    EXPECT_EQ(found.trials[0].vibration.strength_m_s2, 2.5);
    EXPECT_TRUE(std::isnan(found.trials[0].vibration.latency_s));
    ASSERT_EQ(found.thresholds.size(), 3U);
    EXPECT_EQ(found.thresholds[0].type, "catch");
    EXPECT_EQ(found.thresholds[2].type, "stimulus");
}

}  // namespace
}  // namespace tacto
