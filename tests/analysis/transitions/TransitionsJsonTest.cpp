// What the bench writes of a change is what its analysis reads.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/analysis/transitions/TransitionsJson.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using nlohmann::json;

json stepRow() {
    return {{"name", "pressed"},
            {"type", "step"},
            {"step_s", 7.25},
            {"since_onset_s", 0.5},
            {"latency_s", 0.75},
            {"designed_latency_s", 0.76},
            {"designed_latency_low_s", 0.7},
            {"designed_latency_high_s", 0.8},
            {"trains", nullptr},
            {"designed_trains", 8},
            {"designed_trains_high", 9},
            {"complete_s", nullptr},
            {"designed_complete_s", 12.5},
            {"fastest_complete_s", 11.5},
            {"fewest_trains", 7},
            {"from_v", 10},
            {"to_v", 40},
            {"from_s", 2},
            {"to_s", 0.5},
            {"before_v", {10.01, nullptr, 9.99}},
            {"onsets",
             {{{"after_step_s", 0.75},
               {"amplitude_v", 12},
               {"interval_s", 1.25},
               {"onset_u_s", nullptr},
               {"amplitude_u_v", 0.01},
               {"amplitude_jnd", 1.9},
               {"interval_jnd", 0.1}}}},
            {"captures", {4, 3}}};
}

TEST(TransitionsJson, AStepIsWrittenAsItWasRead) {
    const auto step = test::accepted(capturedChangeFrom(stepRow()));
    EXPECT_EQ(step.kind, ChangeKind::Step);
    EXPECT_TRUE(std::isnan(step.measured.trains));
    EXPECT_EQ(step.designedLast.trains, 9);
    EXPECT_EQ(step.before_v.size(), 3U);
    EXPECT_EQ(toJson(step), stepRow());
}

TEST(TransitionsJson, AMovementIsWrittenAsItWasRead) {
    const json row{{"name", "across"}, {"type", "movement"}, {"seconds", 5}, {"onsets", stepRow()["onsets"]}};
    const auto movement = test::accepted(capturedChangeFrom(row));
    EXPECT_EQ(movement.kind, ChangeKind::Movement);
    EXPECT_EQ(toJson(movement), row);
}

TEST(TransitionsJson, TheBenchGivesNoName) {
    EXPECT_FALSE(toJson(CapturedChange{}).contains("name"));
    auto row = stepRow();
    row.erase("name");
    EXPECT_THAT(capturedChangeFrom(row), test::refused(ErrorCode::InvalidArgument, "\"name\" is missing"));
}

TEST(TransitionsJson, RefusesWhatIsOfAnotherType) {
    const std::pair<const char*, json> wrong[] = {
        {"latency_s", "soon"}, {"before_v", {"10"}}, {"onsets", 3}, {"type", "jump"}, {"captures", {1.5}}};
    for (const auto& [key, value] : wrong) {
        auto row = stepRow();
        row[key] = value;
        EXPECT_THAT(capturedChangeFrom(row), test::refusedSaying(key)) << key;
    }
}

}  // namespace
}  // namespace tacto
