// What a session's rows show: which trials have an answer, which were begun, and how often.
// How a participant's range and the study's encoding define the four conditions.
#include <gtest/gtest.h>

#include "core/pilot/PilotRecord.h"
#include "core/pilot/PilotSettings.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionWriter.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

using nlohmann::json;

struct Part {
    explicit Part(const std::vector<SessionRow>& earlier = {}) : record(*writer, clock, earlier) {}
    /// The rows that a later part gets.
    [[nodiscard]] std::vector<SessionRow> rows() const {
        return SessionReader::open(dir.path() / "s.tacto").value().events().value();
    }
    test::ScratchDir dir;
    VirtualClock clock;
    std::unique_ptr<SessionWriter> writer = SessionWriter::create(dir.path() / "s.tacto", {}, clock).value();
    PilotRecord record;
};

json numbered(int number, int attempt) {
    return {{"number", number},   {"phase", "test"},        {"block", 1},      {"condition", "rough-high"},
            {"attempt", attempt}, {"current_ma", 4.5},      {"interval_s", 2}, {"rt_s", 0.5},
            {"trains", 3},        {"response", "rough-low"}};
}

TEST(PilotRecord, ALaterPartHasWhatTheEarlierOneWrote) {
    RecordProperty("hazard", "H8");
    Part first;
    EXPECT_FALSE(first.record.isResumed());
    ASSERT_TRUE(first.record.write(row::kTrialBegin, "test 1", numbered(1, 1)));
    ASSERT_TRUE(first.record.write(row::kAnswer, "test 1", numbered(1, 1)));
    ASSERT_TRUE(first.record.write(row::kTrialBegin, "test 2", numbered(2, 1)));

    const Part second(first.rows());
    EXPECT_TRUE(second.record.isResumed());
    ASSERT_NE(second.record.find(row::kAnswer, "test 1"), nullptr);
    EXPECT_EQ((*second.record.find(row::kAnswer, "test 1"))["response"], "rough-low");
    EXPECT_EQ(second.record.find(row::kAnswer, "test 2"), nullptr);
    EXPECT_EQ(second.record.begun("test 2"), 1U);
    EXPECT_EQ(second.record.written(), 0U);
}

TEST(PilotRecord, WhatHappensOnceIsMadeOnceOverAllParts) {
    RecordProperty("hazard", "H8");
    int made = 0;
    const auto make = [&made]() -> Result<json> { return json{{"seed", ++made}}; };
    Part first;
    ASSERT_TRUE(first.record.once(row::kPlan, "plan", make));
    EXPECT_EQ((*first.record.once(row::kPlan, "plan", make))["seed"], 1);
    Part second(first.rows());
    EXPECT_EQ((*second.record.once(row::kPlan, "plan", make))["seed"], 1);
    EXPECT_EQ(made, 1);
}

TEST(PilotRecord, ARowThatIsRefusedIsNotThere) {
    RecordProperty("hazard", "H8");
    Part part;
    ASSERT_TRUE(part.writer->close());
    EXPECT_FALSE(part.record.write(row::kTrialBegin, "test 1", numbered(1, 1)));
    EXPECT_EQ(part.record.begun("test 1"), 0U);
    EXPECT_EQ(part.record.written(), 0U);
}

TEST(PilotTrials, OpenOnesAreThoseBegunWithoutAnAnswer) {
    Part part;
    ASSERT_TRUE(part.record.write(row::kPlan, "plan", {{"trials", json::array({numbered(1, 1)})}}));
    for (const int number : {1, 2}) ASSERT_TRUE(part.record.write(row::kTrialBegin, "t", numbered(number, 1)));
    ASSERT_TRUE(part.record.write(row::kAnswer, "t", numbered(1, 1)));
    ASSERT_TRUE(part.record.write(row::kTrialBegin, "t", numbered(2, 2)));
    const auto found = pilotTrials(part.rows());
    EXPECT_EQ(found.plan.size(), 1U);
    ASSERT_EQ(found.trials.size(), 1U);
    EXPECT_EQ(found.trials[0].condition, "rough-high");
    EXPECT_EQ(found.trials[0].response, "rough-low");
    EXPECT_EQ(found.trials[0].current, Milliamps(4.5));
    EXPECT_EQ(found.open, (std::vector<OpenTrial>{{2, 2}}));
}

TEST(PilotTrials, OneWithoutAnAnswerIsKeptUntilItIsAnswered) {
    Part part;
    auto silent = numbered(3, 1);
    silent["response"] = nullptr;
    ASSERT_TRUE(part.record.write(row::kNoAnswer, "t", silent));
    auto found = pilotTrials(part.rows());
    ASSERT_EQ(found.trials.size(), 1U);
    EXPECT_EQ(found.trials[0].response, "");
    EXPECT_TRUE(found.open.empty());
    ASSERT_TRUE(part.record.write(row::kAnswer, "t", numbered(3, 2)));
    found = pilotTrials(part.rows());
    ASSERT_EQ(found.trials.size(), 1U);
    EXPECT_EQ(found.trials[0].attempt, 2U);
}

TEST(PresentedConditions, AreTheEndsOfTheRangeAndOfTheIntervals) {
    const auto all = presentedConditions({}, 3.5, 7, 0.5);
    ASSERT_EQ(all.size(), 4U);
    const struct {
        const char* name;
        double level, interval;
    } expected[] = {{"smooth-low", 3.5, 2}, {"smooth-high", 3.5, 0.5}, {"rough-low", 7, 2}, {"rough-high", 7, 0.5}};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(all[i].name, expected[i].name);
        EXPECT_EQ(all[i].level, expected[i].level);
        EXPECT_EQ(all[i].interval.count(), expected[i].interval);
    }
}

TEST(PresentedConditions, SwappedPressureIsTheLevelAndTextureTheInterval) {
    PilotSettings settings;
    settings.assignment = Assignment::Swapped;
    const auto all = presentedConditions(settings, 3.5, 7, 0.5);
    EXPECT_EQ(all[1].name, "smooth-high");
    EXPECT_EQ(all[1].level, 7);
    EXPECT_EQ(all[1].interval.count(), 2);
    EXPECT_EQ(all[2].level, 3.5);
    EXPECT_EQ(all[2].interval.count(), 0.5);
}

TEST(PresentedConditions, BetweenTheEndsLieOnTheDevicesGrid) {
    PilotSettings settings;
    settings.conditions = {{"middle", 0.4, 0.5}};
    const auto all = presentedConditions(settings, 3.5, 7, 0.5);
    EXPECT_NEAR(all[0].level, 5, 1e-9);
    EXPECT_NEAR(all[0].interval.count(), 1.25, 1e-9);
}

TEST(FoundRows, ARangeIsReadAsItWasWrittenInItsUnit) {
    const RangeRow current{.usable = true,
                           .min = 4,
                           .max = 6.5,
                           .jnd = 5.1,
                           .limitedBy = LevelLimit::Cap,
                           .minVoltage = Volts(14),
                           .maxVoltage = Volts(22),
                           .impedance = Ohms(3400)};
    const auto body = toJson(current);
    EXPECT_EQ(body, json({{"usable", true},
                          {"reason", nullptr},
                          {"min_ma", 4.0},
                          {"max_ma", 6.5},
                          {"jnd", 5.1},
                          {"limited_by", "cap"},
                          {"min_v", 14.0},
                          {"max_v", 22.0},
                          {"impedance_ohm", 3400.0}}));
    EXPECT_EQ(toJson(rangeRowFrom(body)), body);

    const auto none = toJson(RangeRow{.unit = LevelUnit::Intensity, .reason = "no room"});
    EXPECT_EQ(none, json({{"usable", false},
                          {"reason", "no room"},
                          {"min_intensity", nullptr},
                          {"max_intensity", nullptr},
                          {"jnd", nullptr},
                          {"limited_by", "too-strong"}}));
    const auto read = rangeRowFrom(none);
    EXPECT_EQ(read.unit, LevelUnit::Intensity);
    EXPECT_EQ(toJson(read), none);
}

TEST(FoundRows, ADriftIsReadAsItWasWrittenInItsUnit) {
    for (const auto unit : {LevelUnit::Current, LevelUnit::Intensity}) {
        const auto body = toJson(DriftRow{
            .unit = unit, .block = 3, .detection = {2.5, 2.1, 2.9}, .probability = 0.9, .rests = 2, .adapted = true});
        EXPECT_EQ(body, json({{"block", 3},
                              {levelKey("detection", unit), {{"value", 2.5}, {"low", 2.1}, {"high", 2.9}}},
                              {"probability", 0.9},
                              {"rests", 2},
                              {"adapted", true}}));
        EXPECT_EQ(toJson(driftRowFrom(body)), body);
    }
}

TEST(FoundRows, WhatCannotBeReadIsUnknownAndNeverZero) {
    RecordProperty("hazard", "H8");
    for (const auto& body : {json(), json(7), json::array({1}), json::object(),
                             json({{"min_ma", "4"}, {"usable", 1}, {"seed", -1}, {"detection_ma", {1}}})}) {
        EXPECT_TRUE(std::isnan(rangeRowFrom(body).min)) << body;
        EXPECT_FALSE(rangeRowFrom(body).usable) << body;
        EXPECT_TRUE(std::isnan(driftRowFrom(body).detection.value)) << body;
        EXPECT_EQ(planRowFrom(body).blocks, 0U) << body;
    }
    EXPECT_EQ(planRowFrom({{"name", "plan"}, {"seed", 18446744073709551615U}, {"blocks", 5}, {"trials", nullptr}}).seed,
              18446744073709551615U);
}

}  // namespace
}  // namespace tacto
