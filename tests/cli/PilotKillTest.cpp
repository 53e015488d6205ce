// A session that is killed at any of its rows continues as if nothing had happened: plan and answers are identical.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/study/StudyVerify.h"
#include "tests/cli/PilotDesk.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

const Words kGoOn{"--set", "unfinished=resume"};

/// A session that is killed at each of its moments in turn, each time in a separate run.
struct KilledSession {
    const char* name;
    const char* protocol;
    Words devices;
    Words words;
    long shards;              ///< number of parallel tests that share the moments
    TrialCounts<long> every;  ///< distance between the moments; 1: every moment
    bool twice;               ///< kills the program again after it was resumed
};

const KilledSession kKilledSessions[] = {
    // Contains thresholds by QUEST+, familiarisation, training, a break and drift check between two blocks, ratings.
    {"TwoBlocks",
     "pilot-identification",
     {"sim:"},
     {"--set", "participant=virtual:7", "--set", "blocks=2"},
     8,
     {.local = 24, .ci = 1, .campaign = 1},
     false},
    {"Staircase",
     "pilot-thresholds",
     {"sim:"},
     {"--set", "participant=virtual:5", "--set", "method=staircase", "--set", "comparison=yes"},
     1,
     {.local = 80, .ci = 4, .campaign = 1},
     false},
    // The long break with a skin inspection; masking noise; killed twice.
    {"FourBlocksWithAMassagerTwice",
     "pilot-identification",
     {"sim:massager"},
     {"--set", "participant=virtual:7", "--set", "blocks=4"},
     1,
     {.local = 120, .ci = 12, .campaign = 1},
     true},
    // Rests of five minutes in the drift check, and a marked block.
    {"Adapted",
     "pilot-identification",
     {"sim:"},
     {"--set", "participant=virtual:7", "--set", "blocks=2", "--set", "adaptation=3"},
     1,
     {.local = 120, .ci = 12, .campaign = 1},
     false},
};

struct KillShard {
    const KilledSession* session;
    long shard;
};

std::vector<KillShard> killShards() {
    std::vector<KillShard> all;
    for (const auto& session : kKilledSessions)
        for (long shard = 0; shard < session.shards; ++shard) all.push_back({&session, shard});
    return all;
}

class PilotKill : public testing::TestWithParam<KillShard> {};

/// Returns the outcome of a session without what depends on restarts: |Z| is measured again after each.
std::string cameTo(const nlohmann::json& value) {
    const auto& results = value["results"];
    auto range = results["range"];
    for (const char* measured : {"impedance_ohm", "min_v", "max_v"}) range.erase(measured);
    if (results.contains("confusion"))
        return planAndAnswers(value) + '\n' + range.dump() + '\n' + results["drift"].dump();
    return results["series"].dump() + '\n' + results["detection"].dump() + '\n' + results["comparison"].dump() + '\n' +
           range.dump();
}

/// Returns plan and answers of the study's only session if it is complete on disk.
std::optional<std::string> completeIn(const PilotDesk& desk, const std::string& study) {
    const auto opened = Study::open(desk.desk().at(study), nullptr, Study::Access::Read);
    if (!opened) return std::nullopt;
    const auto sessions = opened->sessions();
    if (sessions.empty() || sessions[0].state != StudySessionState::Complete) return std::nullopt;
    const auto listed = desk.desk().run({"study", "trials", desk.desk().at(study), sessions[0].code, "--json"});
    EXPECT_EQ(listed.code, 0) << listed.err;
    auto trials = jsonOf(listed)["trials"];
    for (auto& trial : trials) trial.erase("attempt");
    return trials.dump();
}

TEST_P(PilotKill, AtEveryDurableRowGoesOnAsIfUndisturbed) {
    RecordProperty("hazard", "H8");
    const auto& [session, shard] = GetParam();
    const PilotDesk desk(session->devices);
    const auto undisturbed = desk.run(session->protocol, session->words, "whole");
    ASSERT_EQ(undisturbed.code, 0) << undisturbed.err;
    const auto expected = cameTo(jsonOf(undisturbed));
    auto answers = jsonOf(undisturbed)["results"].value("trials", nlohmann::json::array());
    for (auto& trial : answers) trial.erase("attempt");
    const auto fromTheSeed = session->words + kGoOn;
    const auto resumed = fromTheSeed + Words{"--seed", "99"};  // the stored plan is used
    long killed = 0;
    const long every = trials(session->every);
    for (long sync = 1 + shard + every / 2;; sync += session->shards * every) {
        const auto study = "killed " + std::to_string(sync);
        const int code = desk.runKilled(sync, session->protocol, session->words, study);
        if (code == 0) break;  // the session has fewer moments
        ASSERT_EQ(code, -9) << "sync " << sync;
        ++killed;
        if (const auto kept = completeIn(desk, study)) {  // only the program's own end was missing
            EXPECT_EQ(*kept, answers.dump()) << "sync " << sync;
            std::filesystem::remove_all(desk.desk().at(study));
            continue;
        }
        // A plan that is not durable yet cannot be used; the plan is then drawn from the seed.
        const auto& words = desk.desk().named(study + "/sessions", ".tacto").empty() ? fromTheSeed : resumed;
        if (session->twice) {
            const int again = desk.runKilled(20 + sync / 3, session->protocol, words, study);
            if (completeIn(desk, study)) continue;
            ASSERT_EQ(again, -9) << "sync " << sync;
        }
        const auto ran = desk.run(session->protocol, words, study);
        ASSERT_EQ(ran.code, 0) << "sync " << sync << ": " << ran.err;
        EXPECT_EQ(cameTo(jsonOf(ran)), expected) << "sync " << sync;
        const auto verified = verifyStudy(desk.desk().at(study));
        ASSERT_TRUE(verified && verified->status == SessionStatus::Intact) << "sync " << sync;
        std::filesystem::remove_all(desk.desk().at(study));
    }
    EXPECT_GE(killed, 3);
}

INSTANTIATE_TEST_SUITE_P(EveryMoment, PilotKill, testing::ValuesIn(killShards()), [](const auto& tested) {
    return tested.param.session->name + std::to_string(tested.param.shard);
});

}  // namespace
}  // namespace tacto::test
