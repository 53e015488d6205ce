// Whether an accelerometer's readings separate the four conditions of a massager.
#include <gmock/gmock.h>

#include "core/analysis/vibration/VibrationSeparability.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using testing::HasSubstr;

const std::vector<std::string> kFourNames{"smooth-low", "smooth-high", "rough-low", "rough-high"};

BurstFigures moved(double strength, double interval_s) {
    BurstFigures out;
    out.bursts = out.moved = 3;
    out.strength_m_s2 = strength;
    out.interval_s = interval_s;
    out.latency_s = 0.012;
    out.rise_s = 0.06;
    out.strengthUncertainty_m_s2 = 0.001;
    out.intervalUncertainty_s = 1e-4;
    return out;
}

BurstFigures still(std::size_t missed = 0) {
    BurstFigures out;
    out.bursts = 3;
    out.missed = missed;
    return out;
}

/// Returns 25 trials of each condition; strengths vary by 1 %.
std::vector<VibrationTrial> trials(double smooth = 1, double rough = 3) {
    std::vector<VibrationTrial> all;
    for (int n = 0; n < 25; ++n) {
        for (const auto& name : kFourNames) {
            const double strength = (name.starts_with("rough") ? rough : smooth) * (1 + 0.01 * (n % 3 - 1));
            const double interval = (name.ends_with("high") ? 0.5 : 2) * (1 + 0.001 * (n % 5 - 2));
            all.push_back({name, name.starts_with("rough") ? 0.6 : 0.3, interval, moved(strength, interval)});
        }
    }
    return all;
}

TEST(VibrationSeparability, StrengthAndRhythmSeparateTheFour) {
    const auto found = test::accepted(judgeVibration(trials(), kFourNames));
    EXPECT_TRUE(found.measured);
    EXPECT_EQ(found.verdict, Verdict::Pass) << testing::PrintToString(found.reasons);
    ASSERT_EQ(found.conditions.size(), 4U);
    const auto& first = found.conditions.front();
    EXPECT_EQ(first.name, "smooth-low");
    EXPECT_EQ(first.presentations, 25U);
    EXPECT_EQ(first.moved, 75U);
    EXPECT_NEAR(first.strength_m_s2.mean, 1, 0.01);
    EXPECT_NEAR(first.measuredInterval_s.mean, 2, 0.01);
    EXPECT_NEAR(first.latency_s.mean, 0.012, 1e-9);
    EXPECT_EQ(found.pairs.size(), 6U);
    const auto json = toJson(found);
    EXPECT_EQ(json["verdict"], "pass");
    EXPECT_EQ(json["conditions"][3]["name"], "rough-high");
    for (const char* electrical : {"_ma\"", "_v\"", "amplitude"})
        EXPECT_EQ(json["conditions"].dump().find(electrical), std::string::npos) << electrical;
}

TEST(VibrationSeparability, StrengthsThatAreAlikeFail) {
    RecordProperty("hazard", "H9");
    const auto found = test::accepted(judgeVibration(trials(1, 1.1), kFourNames));
    EXPECT_EQ(found.verdict, Verdict::Fail);
    EXPECT_THAT(found.reasons.front(), HasSubstr("just-noticeable differences"));
}

TEST(VibrationSeparability, AMotorThatStoodStillFails) {
    RecordProperty("hazard", "H9");
    auto all = trials();
    for (auto& each : all) {
        if (each.condition == "smooth-low") each.measured = still();
    }
    const auto found = test::accepted(judgeVibration(all, kFourNames));
    EXPECT_TRUE(found.measured);
    EXPECT_EQ(found.verdict, Verdict::Fail);
    EXPECT_EQ(found.reasons.front(), "The motor did not move in 75 of 75 bursts of smooth-low.");
}

TEST(VibrationSeparability, WhatWasNotMeasuredNeverPasses) {
    RecordProperty("hazard", "H9");
    auto some = trials();
    some[0].measured = still(3);
    const auto open = test::accepted(judgeVibration(some, kFourNames));
    EXPECT_EQ(open.verdict, Verdict::Indeterminate);
    for (auto& each : some) each.measured = BurstFigures{};
    const auto none = test::accepted(judgeVibration(some, kFourNames));
    EXPECT_FALSE(none.measured);
    EXPECT_EQ(none.verdict, Verdict::Indeterminate);
    ASSERT_EQ(none.reasons.size(), 1U);
    EXPECT_THAT(none.reasons.front(), HasSubstr("Not measured"));
    const auto json = toJson(none);
    EXPECT_FALSE(json["measured"].get<bool>());
    EXPECT_TRUE(json["verdict"].is_null());
    EXPECT_TRUE(json["conditions"][0]["strength_m_s2"]["mean"].is_null()) << "unknown is not zero";
    EXPECT_FALSE(judgeVibration({}, kFourNames)->measured);
}

TEST(VibrationSeparability, FiguresComeBackFromARow) {
    const auto figures = moved(2.5, 0.5);
    const auto back = burstFiguresFrom(toJson(figures));
    EXPECT_EQ(toJson(back), toJson(figures));
    EXPECT_TRUE(std::isnan(back.noise_m_s2));
    EXPECT_EQ(back.moved, 3U);
}

TEST(VibrationSeparability, WhatADamagedRowDoesNotSayIsNotKnown) {
    RecordProperty("hazard", "H9");
    for (const nlohmann::json& said : {nlohmann::json(nullptr), nlohmann::json::array({1}),
                                       nlohmann::json{{"moved", -1}, {"strength_m_s2", "2"}, {"more", 1}}}) {
        const auto back = burstFiguresFrom(said);
        EXPECT_EQ(back.moved, 0U) << said;
        EXPECT_TRUE(std::isnan(back.strength_m_s2)) << said;
    }
    EXPECT_EQ(burstFiguresFrom({{"more", 1}, {"moved", 2}}).moved, 2U);
}

}  // namespace
}  // namespace tacto
