// A session that is killed at any of its rows goes on as if nothing had happened: plan and answers byte for byte.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>

#include "tests/cli/PilotDesk.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

constexpr long kShards = 8;

/// Each takes every eighth of the moments, so that several run beside each other.
class PilotKill : public testing::TestWithParam<long> {};

/// Without what only says how often a trial was begun.
std::string answersOf(nlohmann::json trials) {
    for (auto& trial : trials) trial.erase("attempt");
    return trials.dump();
}

std::string expectedOf(const Ran& ran) { return answersOf(jsonOf(ran)["results"]["trials"]); }

/// The answers of the study's only session, where that is complete on disk.
std::optional<std::string> completeIn(const PilotDesk& desk, const std::string& study) {
    const auto shown = desk.desk().run({"study", "show", desk.desk().at(study), "--json"});
    if (shown.code != 0) return std::nullopt;
    const Json sessions = jsonOf(shown)["sessions"];
    if (sessions.empty() || sessions[0]["state"] != "complete") return std::nullopt;
    const auto listed =
        desk.desk().run({"study", "trials", desk.desk().at(study), sessions[0]["code"].get<std::string>(), "--json"});
    EXPECT_EQ(listed.code, 0) << listed.err;
    return answersOf(jsonOf(listed)["trials"]);
}

TEST_P(PilotKill, AtEveryDurableRowGoesOnAsIfUndisturbed) {
    RecordProperty("hazard", "H8");
    const PilotDesk desk;
    const auto undisturbed = desk.run("pilot-identification", shortSession(), "whole");
    ASSERT_EQ(undisturbed.code, 0) << undisturbed.err;
    const auto expected = planAndAnswers(jsonOf(undisturbed));
    auto fromTheSeed = shortSession();
    fromTheSeed.insert(fromTheSeed.end(), {"--set", "unfinished=resume"});
    auto resumed = fromTheSeed;
    resumed.insert(resumed.end(), {"--seed", "99"});  // The stored plan holds
    long killed = 0;
    const long stride = kShards * trials<long>({.local = 8, .ci = 1, .campaign = 1});
    for (long sync = 1 + GetParam();; sync += stride) {
        const auto study = "killed " + std::to_string(sync);
        const int code = desk.runKilled(sync, "pilot-identification", shortSession(), study);
        if (code == 0) break;  // It has fewer
        ASSERT_EQ(code, -9) << "sync " << sync;
        ++killed;
        if (const auto kept = completeIn(desk, study)) {  // only the program's own end was left
            EXPECT_EQ(*kept, expectedOf(undisturbed)) << "sync " << sync;
            std::filesystem::remove_all(desk.desk().at(study));
            continue;
        }
        // Before the plan is durable there is none that could hold: it is drawn from the seed.
        const auto& words = desk.desk().named(study + "/sessions", ".tacto").empty() ? fromTheSeed : resumed;
        const auto ran = desk.run("pilot-identification", words, study);
        ASSERT_EQ(ran.code, 0) << "sync " << sync << ": " << ran.err;
        EXPECT_EQ(planAndAnswers(jsonOf(ran)), expected) << "sync " << sync;
        ASSERT_EQ(desk.desk().run({"verify", desk.desk().at(study)}).code, 0) << "sync " << sync;
        std::filesystem::remove_all(desk.desk().at(study));
    }
    EXPECT_GT(killed, 3);
}

INSTANTIATE_TEST_SUITE_P(EveryMoment, PilotKill, testing::Range(0L, kShards));

}  // namespace
}  // namespace tacto::test
