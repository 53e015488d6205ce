// A rehearsal with a massager, from plan to confusion matrix: strengths instead of currents; killed and resumed; the
// motion of its motor, if a sensor board is attached.
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "tests/cli/PilotDesk.h"

namespace tacto::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const Words kMassager{"sim:massager"};

/// Adds every key in a value, at any depth.
void addKeys(const json& value, std::set<std::string>& keys) {
    for (const auto& [key, member] : value.items()) {
        if (value.is_object()) keys.insert(key);
        if (member.is_structured()) addKeys(member, keys);
    }
}

void expectNothingElectrical(const json& value) {
    std::set<std::string> keys;
    addKeys(value, keys);
    for (const auto& key : keys) {
        for (const char* unit : {"_ma", "_v", "_ohm"}) EXPECT_FALSE(key.ends_with(unit)) << key;
        EXPECT_THAT(key, Not(HasSubstr("impedance")));
    }
}

TEST(PilotMassager, ARehearsalGoesFromPlanToConfusionMatrix) {
    const PilotDesk desk(kMassager);
    const auto ran = desk.run("pilot-identification", {"--set", "participant=virtual:7", "--seed", "1"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto value = jsonOf(ran);
    ASSERT_EQ(value["devices"].size(), 1U);
    EXPECT_EQ(value["devices"][0]["role"], "massager");
    const auto& results = value["results"];
    EXPECT_EQ(results["modality"], "massager");
    EXPECT_EQ(results["n"], 80);
    EXPECT_EQ(results["catch"]["n"], 10);
    EXPECT_GT(results["hits"].get<int>(), 40);
    const double low = results["range"]["min_intensity"], high = results["range"]["max_intensity"];
    EXPECT_TRUE(results["range"]["usable"].get<bool>());
    EXPECT_GT(low, 0);
    EXPECT_LT(low, high);
    EXPECT_LT(high, results["truth"]["too_strong_intensity"].get<double>());
    EXPECT_LE(high, 1);
    for (const auto& condition : results["presented"]) {
        const bool rough = condition["name"].get<std::string>().starts_with("rough");
        const bool firm = condition["name"].get<std::string>().ends_with("high");
        EXPECT_EQ(condition["intensity"], rough ? high : low);
        EXPECT_EQ(condition["interval_s"], firm ? 0.5 : 2);
    }
    EXPECT_THAT(results["headline"].get<std::string>(), HasSubstr("between strengths of"));
    EXPECT_FALSE(results["vibration"]["measured"].get<bool>());
    EXPECT_TRUE(results["vibration"]["verdict"].is_null());
    EXPECT_THAT(results["vibration"]["reasons"][0].get<std::string>(), HasSubstr("Not measured"));
    expectNothingElectrical(results);
    EXPECT_EQ(desk.desk().run({"verify", desk.desk().at("study")}).code, 0);

    const auto shown = jsonOf(desk.desk().run({"study", "show", desk.desk().at("study"), "--json"}));
    EXPECT_EQ(shown["modality"], "massager");
    EXPECT_EQ(shown["sessions"][0]["state"], "complete");
    EXPECT_THAT(desk.desk().run({"study", "show", desk.desk().at("study")}).out, HasSubstr("modality massager"));
    const auto out = desk.desk().at("shared");
    ASSERT_EQ(desk.desk().run({"export", desk.desk().at("study"), "--format", "bids", "--out", out}).code, 0);
    EXPECT_THAT(contentOf(out + "/README"), HasSubstr("Modality: massager"));
}

TEST(PilotMassager, ThresholdsComeNearTheTruthInStrength) {
    const PilotDesk desk(kMassager);
    const auto ran = desk.run("pilot-thresholds", {"--set", "participant=virtual:7"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto results = jsonOf(ran)["results"];
    EXPECT_EQ(results["modality"], "massager");
    const double truth = results["truth"]["detection_intensity"];
    EXPECT_NEAR(results["detection"]["estimate_intensity"]["value"].get<double>(), truth, 0.35 * truth);
    EXPECT_TRUE(results["detection"]["history"][0].contains("intensity"));
    EXPECT_TRUE(results["series"][0].contains("felt_intensity"));
    expectNothingElectrical(results);
}

TEST(PilotMassager, KilledItGoesOnAsIfUndisturbed) {
    RecordProperty("hazard", "H8");
    const PilotDesk desk(kMassager);
    const auto undisturbed = desk.run("pilot-identification", shortSession(), "whole");
    ASSERT_EQ(undisturbed.code, 0) << undisturbed.err;
    const auto expected = planAndAnswers(jsonOf(undisturbed));
    const auto resume = shortSession() + Words{"--set", "unfinished=resume"};
    for (const long sync : {40L, 130L, 220L}) {  // during ascending limits, detection and trials
        const auto study = "killed " + std::to_string(sync);
        ASSERT_EQ(desk.runKilled(sync, "pilot-identification", shortSession(), study), -9) << sync;
        const auto ran = desk.run("pilot-identification", resume, study);
        ASSERT_EQ(ran.code, 0) << "sync " << sync << ": " << ran.err;
        const auto value = jsonOf(ran);
        EXPECT_TRUE(value["results"]["resumed"].get<bool>());
        EXPECT_EQ(planAndAnswers(value), expected) << "sync " << sync;
        EXPECT_EQ(desk.desk().run({"verify", desk.desk().at(study)}).code, 0);
    }
}

TEST(PilotMassager, TheBoardOnTheMotorSaysWhatItDid) {
    RecordProperty("hazard", "H9");
    const PilotDesk desk({"sim:massager?acceleration=60m/s2", "sim:finger?on=motor&rate=2kHz"});
    const auto ran = desk.run("pilot-identification", shortSession());
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto results = jsonOf(ran)["results"];
    const auto& vibration = results["vibration"];
    EXPECT_TRUE(vibration["measured"].get<bool>());
    ASSERT_EQ(vibration["conditions"].size(), 4U);
    for (const auto& condition : vibration["conditions"]) {
        EXPECT_GT(condition["presentations"].get<int>(), 4);
        EXPECT_EQ(condition["moved"], condition["bursts"]) << condition.dump();
        EXPECT_EQ(condition["missed"], 0);
        const double told = condition["interval_s"];
        EXPECT_NEAR(condition["measured_interval_s"]["mean"].get<double>(), told, 0.01 * told);
        EXPECT_GT(condition["latency_s"]["mean"].get<double>(), 0);
        EXPECT_GT(condition["rise_s"]["mean"].get<double>(), 0);
    }
    const auto strengthOf = [&](std::size_t at) {
        return vibration["conditions"][at]["strength_m_s2"]["mean"].get<double>();
    };
    EXPECT_EQ(results["labels"], json({"smooth-low", "smooth-high", "rough-low", "rough-high"}));
    EXPECT_GT(strengthOf(2), 1.5 * strengthOf(0)) << "rough is stronger";
    EXPECT_NEAR(strengthOf(1) / strengthOf(0), 1, 0.1) << "pressure changes the rhythm alone";
    for (const auto& pair : vibration["pairs"])
        EXPECT_GE(std::max(pair["strength_jnd"].get<double>(), pair["interval_jnd"].get<double>()), 5) << pair.dump();
}

TEST(PilotMassager, AnotherModalityThanTheStudysIsRefused) {
    RecordProperty("hazard", "H12");
    const PilotDesk desk(kMassager);
    ASSERT_EQ(desk.run("pilot-thresholds", {"--set", "participant=virtual:7"}).code, 0);
    const auto refused =
        desk.run("pilot-thresholds", {"--set", "participant=virtual:7", "--set", "modality=electrodes"});
    EXPECT_EQ(refused.code, 4) << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("modality is electrodes; massager, that of the study in"));
}

TEST(PilotMassager, OneThatTellsTooFewStrengthsApartIsRefusedWithNothingBooked) {
    RecordProperty("hazard", "H12");
    const PilotDesk desk({"sim:massager?step=0.25"});
    const auto refused = desk.run("pilot-thresholds", {"--set", "participant=virtual:7"});
    EXPECT_EQ(refused.code, 4) << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("0.25 from each other; 0.05 is expected"));
    const auto shown = jsonOf(desk.desk().run({"study", "show", desk.desk().at("study"), "--json"}));
    EXPECT_TRUE(shown["sessions"].empty());
}

TEST(PilotMassager, ModalityAloneOpensTheSimulatedMassager) {
    const PilotDesk desk;
    const auto ran = desk.run("pilot-thresholds", {"--set", "participant=virtual:7", "--set", "modality=massager"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(jsonOf(ran)["devices"][0]["role"], "massager");
}

}  // namespace
}  // namespace tacto::test
