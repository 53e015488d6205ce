// Rows of a session with false contents but valid seals and chain, made by someone who has the keys, as everyone has
// for a rehearsal. A session continues from rows that are plausible, or is refused in one sentence; it presents nothing
// that its rows do not lead to.
#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/PilotDesk.h"

namespace tacto::test {
namespace {

using nlohmann::json;

json plan(json trials, json blocks = 1, json seed = 1, json encoding = "standard") {
    return {{"name", "plan"},
            {"seed", std::move(seed)},
            {"encoding", std::move(encoding)},
            {"blocks", std::move(blocks)},
            {"trials", std::move(trials)}};
}
json planned(json number, json condition = "rough-high", json phase = "test", json block = 1) {
    return {{"number", std::move(number)},
            {"phase", std::move(phase)},
            {"block", std::move(block)},
            {"condition", std::move(condition)}};
}

class HostileRows : public testing::Test {
protected:
    /// Continues an unfinished session with these rows.
    Ran goneOnWith(const std::vector<WrittenRow>& rows, const char* protocol) {
        const auto name = "study " + std::to_string(++made_);
        desk.writeUnfinished(name, protocol, rows,
                             std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()));
        return desk.run(protocol, shortSession() + Words{"--set", "unfinished=resume"}, name);
    }
    /// Expects that each of these is refused with `code` and one sentence.
    void expectRefused(std::initializer_list<std::pair<const char*, std::vector<WrittenRow>>> all, const char* protocol,
                       int code) {
        for (const auto& [what, rows] : all) {
            const auto ran = goneOnWith(rows, protocol);
            EXPECT_EQ(ran.code, code) << what << ": " << ran.err << ran.out.substr(0, 2000);
            EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << what << ": " << ran.err;
            EXPECT_EQ(ran.err.find("unexpected"), std::string::npos) << what << ": " << ran.err;
        }
    }
    const PilotDesk desk;
    int made_ = 0;
};

TEST_F(HostileRows, APlanThatCannotBeIsRefused) {
    RecordProperty("hazard", "H10");
    const std::pair<const char*, json> plans[] = {
        {"no trials", plan(nullptr)},
        {"none", plan(json::array())},
        {"trials are a text", plan("all")},
        {"an unknown condition", plan({planned(1, "rough-higher")})},
        {"a condition that looks the same", plan({planned(1, "r\u043eugh-high")})},
        {"an unknown phase", plan({planned(1, "rough-high", "exam")})},
        {"the same number twice", plan({planned(1), planned(1, "smooth-low")})},
        {"number 0", plan({planned(0)})},
        {"a number beyond counting", plan({planned(1e300)})},
        {"a negative number", plan({planned(-1)})},
        {"a block that there is not", plan({planned(1, "rough-high", "test", 7)})},
        {"a trial that is null", plan({nullptr})},
        {"blocks beyond counting", plan({planned(1)}, 1e300)},
        {"2^40 blocks", plan({planned(1)}, std::int64_t{1} << 40)},
        {"no blocks", plan({planned(1)}, 0)},
        {"negative blocks", plan({planned(1)}, -3)},
        {"blocks that are a text", plan({planned(1)}, "5")},
        {"another encoding", plan({planned(1)}, 1, 1, "chest")},
        {"an encoding that is none", plan({planned(1)}, 1, 1, nullptr)},
        {"a seed that is a text", plan({planned(1)}, 1, "one")},
    };
    for (const auto& [what, body] : plans) expectRefused({{what, {{"plan", body}}}}, "pilot-identification", 3);
}

TEST_F(HostileRows, WhatSaysThatItIsCompleteAndIsNotPresentsNothing) {
    RecordProperty("hazard", "H12");
    const auto whole = plan(nullptr);
    expectRefused(
        {
            {"an end alone", {{"session-end", {{"name", "end"}, {"state", "complete"}, {"why", ""}}}}},
            {"plan and end", {{"plan", whole}, {"session-end", {{"name", "end"}, {"state", "complete"}, {"why", ""}}}}},
            {"two ends",
             {{"plan", whole},
              {"session-end", {{"name", "end"}, {"state", "stopped"}, {"why", "third stop"}}},
              {"session-end", {{"name", "end"}, {"state", "complete"}, {"why", ""}}}}},
            {"an end in an unknown state", {{"plan", whole}, {"session-end", {{"name", "end"}, {"state", "done"}}}}},
        },
        "pilot-thresholds", 4);
}

TEST_F(HostileRows, AnswersThatCannotBeAreRefused) {
    RecordProperty("hazard", "H10");
    const auto begin = WrittenRow{"plan", plan(nullptr)};
    const auto ascending = [](json level, json response) {
        return WrittenRow{"answer",
                          {{"name", "ascending 1"},
                           {"series", 1},
                           {"current_ma", std::move(level)},
                           {"response", std::move(response)},
                           {"attempt", 1},
                           {"rt_s", 1}}};
    };
    expectRefused(
        {
            {"a level that is not asked for", {begin, ascending(14.5, "nothing")}},
            {"no level", {begin, ascending(nullptr, "nothing")}},
            {"an unknown answer", {begin, ascending(0, "wonderful")}},
            {"an answer that is a number", {begin, ascending(0, 3)}},
            {"a look-alike", {begin, ascending(0, "n\u043ething")}},
            {"an answer that is null", {begin, ascending(0, nullptr)}},
            {"a step of 0", {begin, {"phase", {{"name", "ascending"}, {"step", 0}, {"cap", 15}}}}},
            {"a step that is not a number", {begin, {"phase", {{"name", "ascending"}, {"step", "1"}, {"cap", 15}}}}},
            {"a cap of 1e300", {begin, {"phase", {{"name", "ascending"}, {"step", 1e-300}, {"cap", 1e300}}}}},
            {"a range above all",
             {begin, {"range", {{"name", "range"}, {"usable", true}, {"min_ma", 20}, {"max_ma", 90}}}}},
        },
        "pilot-thresholds", 3);
}

TEST_F(HostileRows, WhatLeadsNowhereChangesNothing) {
    RecordProperty("hazard", "H6");
    const auto begin = WrittenRow{"plan", plan(nullptr)};
    const auto expected = jsonOf(goneOnWith({begin}, "pilot-thresholds"))["results"]["range"];
    const std::pair<const char*, std::vector<WrittenRow>> all[] = {
        {"a cap beyond the study's", {begin, {"phase", {{"name", "ascending"}, {"step", 0.5}, {"cap", 99}}}}},
        {"a body that is a list", {begin, {"answer", json::array({1, 2})}}},
        {"an accepted level", {begin, {"level-accepted", {{"name", "x"}, {"current_ma", 14}}}}},
        {"an end of another name", {begin, {"session-end", {{"name", "x"}, {"state", "complete"}}}}},
    };
    for (const auto& [what, rows] : all) {
        const auto ran = goneOnWith(rows, "pilot-thresholds");
        EXPECT_EQ(ran.code, 0) << what << ran.err;
        EXPECT_EQ(jsonOf(ran)["results"]["range"], expected) << what;
    }
}

}  // namespace
}  // namespace tacto::test
