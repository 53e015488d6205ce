// What a session's rows say: what has an answer, what was begun, and how often.
#include <gtest/gtest.h>

#include "core/pilot/PilotRecord.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionWriter.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

using nlohmann::json;

struct Part {
    explicit Part(const std::vector<SessionRow>& earlier = {}) : record(*writer, clock, earlier) {}
    /// What a later part is given.
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

}  // namespace
}  // namespace tacto
