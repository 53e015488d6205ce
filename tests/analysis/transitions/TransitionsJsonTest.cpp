// The data about a change that scripts and the session receive.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/analysis/transitions/TransitionsJson.h"

namespace tacto {
namespace {

using nlohmann::json;

const CapturedTrain kTrain{0.75, 12, 1.25, kNaN, 0.01, 1.9, 0.1};

TEST(TransitionsJson, AStepIsWrittenWithAllOfItsFigures) {
    const CapturedChange step{.name = "pressed",
                              .trains = {kTrain},
                              .at_s = 7.25,
                              .sinceOnset_s = 0.5,
                              .measured = {.latency_s = 0.75},
                              .designed = {0.76, 8, 12.5},
                              .designedFirst = {.latency_s = 0.7},
                              .designedLast = {.latency_s = 0.8, .trains = 9},
                              .fastest = {.trains = 7, .complete_s = 11.5},
                              .from_v = 10,
                              .to_v = 40,
                              .from_s = 2,
                              .to_s = 0.5,
                              .before_v = {10.01, kNaN, 9.99},
                              .captures = {4, 3}};
    const json expected{{"name", "pressed"},
                        {"type", "step"},
                        {"step_s", 7.25},
                        {"since_onset_s", 0.5},
                        {"latency_s", 0.75},
                        {"designed_latency_s", 0.76},
                        {"designed_latency_low_s", 0.7},
                        {"designed_latency_high_s", 0.8},
                        {"trains", nullptr},
                        {"designed_trains", 8.0},
                        {"designed_trains_high", 9.0},
                        {"complete_s", nullptr},
                        {"designed_complete_s", 12.5},
                        {"fastest_complete_s", 11.5},
                        {"fewest_trains", 7.0},
                        {"from_v", 10.0},
                        {"to_v", 40.0},
                        {"from_s", 2.0},
                        {"to_s", 0.5},
                        {"before_v", {10.01, nullptr, 9.99}},
                        {"onsets",
                         {{{"after_step_s", 0.75},
                           {"amplitude_v", 12.0},
                           {"interval_s", 1.25},
                           {"onset_u_s", nullptr},
                           {"amplitude_u_v", 0.01},
                           {"amplitude_jnd", 1.9},
                           {"interval_jnd", 0.1}}}},
                        {"captures", {4, 3}}};
    EXPECT_EQ(toJson(step), expected);
}

TEST(TransitionsJson, AMovementHasNoneOfAStepsFigures) {
    const auto row = toJson(CapturedChange{.name = "across", .kind = ChangeKind::Movement, .trains = {kTrain}});
    EXPECT_EQ(row.size(), 4U);
    EXPECT_EQ(row.at("type"), "movement");
    EXPECT_TRUE(row.at("seconds").is_null());
}

TEST(TransitionsJson, TheBenchGivesNoName) { EXPECT_FALSE(toJson(CapturedChange{}).contains("name")); }

}  // namespace
}  // namespace tacto
