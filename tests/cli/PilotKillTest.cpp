// A session that is killed at any of its rows goes on as if nothing had happened: plan and answers byte for byte.
#include <gtest/gtest.h>

#include "tests/cli/PilotDesk.h"

namespace tacto::test {
namespace {

constexpr long kShards = 8;

/// Each takes every eighth of the moments, so that several run beside each other.
class PilotKill : public testing::TestWithParam<long> {};

TEST_P(PilotKill, AtEveryDurableRowGoesOnAsIfUndisturbed) {
    RecordProperty("hazard", "H8");
    const PilotDesk desk;
    const auto undisturbed = desk.run("pilot-identification", shortSession(), "whole");
    ASSERT_EQ(undisturbed.code, 0) << undisturbed.err;
    const auto expected = planAndAnswers(jsonOf(undisturbed));
    auto resumed = shortSession();
    resumed.insert(resumed.end(), {"--seed", "99", "--set", "unfinished=resume"});  // The stored plan holds
    long killed = 0;
    for (long sync = 1 + GetParam();; sync += kShards) {
        const auto study = "killed " + std::to_string(sync);
        const int code = desk.runKilled(sync, "pilot-identification", shortSession(), study);
        if (code == 0) break;  // It has fewer
        ASSERT_EQ(code, -9) << "sync " << sync;
        ++killed;
        // Before anything of the session is durable there is nothing to go on with: a new one has its own seed.
        auto words = resumed;
        if (desk.desk().named(study + "/sessions", ".tacto").empty()) words = shortSession();
        const auto ran = desk.run("pilot-identification", words, study);
        if (ran.code == 4) {  // After the last row: the session has ended, and only the ledger does not say so
            ADD_FAILURE() << "sync " << sync << ": " << ran.err;
            continue;
        }
        ASSERT_EQ(ran.code, 0) << "sync " << sync << ": " << ran.err;
        EXPECT_EQ(planAndAnswers(jsonOf(ran)), expected) << "sync " << sync;
        ASSERT_EQ(desk.desk().run({"verify", desk.desk().at(study)}).code, 0) << "sync " << sync;
        std::filesystem::remove_all(desk.desk().at(study));
    }
    EXPECT_GT(killed, 20);
}

INSTANTIATE_TEST_SUITE_P(EveryMoment, PilotKill, testing::Range(0L, kShards));

}  // namespace
}  // namespace tacto::test
