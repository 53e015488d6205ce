// The transitions protocol on simulated devices: its latency is that of the scheduler, and it fails where it must.
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/analysis/transitions/CapturedChange.h"
#include "core/encoding/Transitions.h"
#include "core/session/SessionReader.h"
#include "tests/scripting/RunBench.h"

namespace tacto {
namespace {

using test::RunBench;
using testing::HasSubstr;
using Settings = std::map<std::string, std::string>;

const std::set<Role> kNeeded{Role::Stimulator, Role::Oscilloscope};

ScriptOutcome sweep(const std::string& device, const Settings& settings, std::uint64_t seed = 1) {
    RunBench rig(true, device, seed, false, kNeeded);
    auto outcome = runProtocol(rig.shipped("transitions", settings)).value();
    EXPECT_TRUE(rig.outputOff());
    return outcome;
}

/// Uses the shipped profile, which limits steps; the profile of RunBench does not.
ScriptOutcome shipped(const Settings& settings, const std::string& device = "sim:") {
    const Settings limits{{"slew", "given"}};  // the protocol's own limits are those of the shipped profile
    Settings all = settings;
    all.insert(limits.begin(), limits.end());
    return sweep(device, all);
}

const nlohmann::json& groupOf(const ScriptOutcome& outcome, const std::string& name) {
    for (const auto& group : outcome.results["changes"]["groups"]) {
        if (group["name"] == name) return group;
    }
    throw std::out_of_range(name);
}

TEST(TransitionsProtocol, FailsStepsThatAreTooLargeOnTheTrainsAsCaptured) {
    const auto outcome = sweep("sim:", {{"repeats", "2"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Fail);
    EXPECT_NEAR(groupOf(outcome, "texture up")["amplitude_jnd"].get<double>(), std::log(4) / std::log(1.1), 0.05);
    EXPECT_NEAR(groupOf(outcome, "pressure down")["interval_jnd"].get<double>(), std::log(4) / std::log(1.16), 0.01);
    EXPECT_NEAR(groupOf(outcome, "smooth-low to rough-high")["amplitude_jnd"].get<double>(),
                std::log(4) / std::log(1.1), 0.1);
    EXPECT_GT(groupOf(outcome, "texture moves at P 0")["amplitude_jnd"].get<double>(), 2) << "at an even pace";
    EXPECT_THAT(outcome.reasons.front(), HasSubstr("just-noticeable differences; at most 2 are wanted"));
    // A change that takes one train is complete with that train.
    for (const auto& group : outcome.results["changes"]["groups"]) {
        EXPECT_EQ(group["late"], 0) << group.dump(1);
        EXPECT_EQ(group["out_of_reach"], 0) << group.dump(1);
    }
    const auto& found = outcome.results["transitions"];
    EXPECT_NEAR(found["abrupt"]["amplitude"]["jnd"].get<double>(), std::log(4) / std::log(1.1), 1e-9);
    EXPECT_EQ(found["amplitude_map"].size(), 11U);
    EXPECT_EQ(outcome.results["latency"]["verdict"], "pass") << outcome.results["latency"].dump(1);
}

TEST(TransitionsProtocol, TheShippedProfilePassesItsOwnTestAndSaysWhatIsOutOfReach) {
    RecordProperty("hazard", "H9");
    const auto outcome = shipped({{"repeats", "3"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Pass) << outcome.results["reasons"].dump(1);
    std::size_t outOfReach = 0;
    for (const auto& group : outcome.results["changes"]["groups"]) {
        // The captured value plus the uncertainty of the captures.
        EXPECT_LE(group["amplitude_jnd"].get<double>() + group["amplitude_u_jnd"].get<double>(), 2) << group.dump(1);
        EXPECT_LE(group["interval_jnd"].get<double>() + group["interval_u_jnd"].get<double>(), 2) << group.dump(1);
        if (!group["completes"].get<bool>()) continue;
        EXPECT_LE(group["trains"]["max"].get<double>(), group["fewest_trains"]["max"].get<double>()) << group.dump(1);
        outOfReach += group["out_of_reach"].get<std::size_t>();
        if (group["complete_s"]["max"].get<double>() > 2) {
            EXPECT_GT(group["fastest_complete_s"]["max"].get<double>(), 2) << group.dump(1);
        }
    }
    EXPECT_GT(outOfReach, 0U);
    for (const char* small : {"a little rougher, pressed", "pressed a little more", "pressed a little less"}) {
        EXPECT_LE(groupOf(outcome, small)["complete_s"]["max"].get<double>(), 2) << small;
        EXPECT_EQ(groupOf(outcome, small)["out_of_reach"], 0) << small;
    }
    ASSERT_FALSE(outcome.results["notes"].empty());
    EXPECT_THAT(outcome.results["notes"][0].get<std::string>(), HasSubstr("out of reach"));
    // 10 to 40 V are 14.5 differences: 8 trains; the old solution needed 24.
    EXPECT_EQ(groupOf(outcome, "texture up")["trains"]["max"], 8);
}

TEST(TransitionsProtocol, FailsAChangeThatTakesMoreTrainsThanItNeeds) {
    RecordProperty("hazard", "H9");
    const auto outcome = shipped({{"repeats", "1"}, {"jumps", "false"}, {"slew_amplitude_ratio", "1.1"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Fail);
    EXPECT_THAT(outcome.reasons.front(),
                HasSubstr("took more trains, 15 at most, than steps of 2 differences need, 8"));
}

TEST(TransitionsProtocol, JudgedBySecondsAloneALargeChangeFails) {
    RecordProperty("hazard", "H9");
    const auto outcome = shipped({{"repeats", "1"}, {"jumps", "false"}, {"complete", "seconds"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Fail);
    EXPECT_THAT(outcome.reasons.front(), HasSubstr("were complete later than 2 s"));
}

TEST(TransitionsProtocol, MeasuresTheSchedulersLatencyInEveryDirection) {
    const auto outcome = sweep("sim:", {{"repeats", "10"}, {"jumps", "false"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& steps = outcome.results["steps"];
    ASSERT_EQ(steps.size(), 40U);
    const double period_s = toSeconds(ControlLoop::kPeriod);
    std::set<std::string> pulled;
    for (const auto& step : steps) {
        const auto name = step["name"].get<std::string>();
        const double since = step["since_onset_s"].get<double>();
        // Calculated by hand: the interval is 2 s to 0.5 s, and 1.25 s while texture changes.
        const double due = name == "pressure up" ? 0.5 : name == "pressure down" ? 2 : 1.25;
        const double design = std::max(0.0, due - since);
        ASSERT_TRUE(step["latency_s"].is_number()) << step.dump(1);
        EXPECT_NEAR(step["latency_s"].get<double>(), design, period_s + 1e-3) << step.dump(1);
        EXPECT_NEAR(step["designed_latency_s"].get<double>(), design, 1e-6) << name;
        EXPECT_EQ(step["trains"], 1) << step.dump(1);
        if (name == "pressure up") pulled.insert(design > 0 ? "forward" : "to now");
    }
    EXPECT_EQ(pulled.size(), 2U) << "steps before and after the new interval has passed";
    for (const auto& group : outcome.results["latency"]["groups"]) {
        EXPECT_EQ(group["n"], 10);
        EXPECT_EQ(group["verdict"], "pass");
        EXPECT_EQ(group["latency_s"]["n"], 10);
    }
}

TEST(TransitionsProtocol, FollowsAStepOverMoreTrainsThanAnOscilloscopeIsAskedForAtOnce) {
    const auto outcome =
        shipped({{"repeats", "1"}, {"jumps", "false"}, {"slew_amplitude_ratio", "0"}, {"slew_v_per_s", "0.25"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& texture = outcome.results["latency"]["groups"][2];
    EXPECT_EQ(texture["name"], "texture up");
    EXPECT_GT(texture["trains"]["max"].get<double>(), 90);  // 30 V at 0.25 V/s with 1.25 s per train takes 96
    // Each train adds a twelfth of a difference, so a reading may find the step complete one train sooner or later.
    EXPECT_NEAR(texture["trains"]["max"].get<double>(), texture["designed_trains"]["max"].get<double>(), 1);
    EXPECT_EQ(outcome.results["latency"]["verdict"], "pass") << outcome.results["reasons"].dump();
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Fail) << "8 trains would do";
}

TEST(TransitionsProtocol, FailsAStimulatorThatIsLate) {
    RecordProperty("hazard", "H9");
    // Every train starts 30 ms after its command; this shows only if a change of pressure should be felt at once.
    const auto outcome = sweep("sim:stimulator?latency=30ms", {{"repeats", "6"}, {"jumps", "false"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& found = outcome.results["latency"];
    EXPECT_EQ(found["verdict"], "fail") << found.dump(1);
    EXPECT_NEAR(found["groups"][0]["difference_s"]["max"].get<double>(), 0.03, 0.006) << found.dump(1);
    EXPECT_EQ(found["groups"][0]["verdict"], "fail");
    EXPECT_EQ(found["groups"][2]["verdict"], "pass") << "texture waits for its train either way";
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Fail);
}

TEST(TransitionsProtocol, NothingMeasuredIsNoPass) {
    RecordProperty("hazard", "H9");
    const auto outcome = sweep("sim:stimulator?load=1.5kohm", {{"slew", "given"}, {"load", "1400"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.results["transitions"]["verdict"], "pass");
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Indeterminate);
    EXPECT_THAT(outcome.reasons.front(), HasSubstr("known-reference check failed"));
    EXPECT_EQ(outcome.results["changes"]["verdict"], "indeterminate");
}

TEST(TransitionsProtocol, UnmeasuredStepsMakeALatencyIndeterminate) {
    RecordProperty("hazard", "H9");
    const auto step = [](const char* name, double latency_s, double trains) {
        CapturedChange change{.name = name};
        change.measured = {.latency_s = latency_s, .trains = trains};
        change.designed = {.latency_s = 0.2, .trains = 1};
        return change;
    };
    const auto good = step("a", 0.201, 1);
    const auto judge = [](const std::vector<CapturedChange>& steps, const std::vector<std::string>& names) {
        return judgeLatency(steps, names, 0.02).verdict;
    };
    EXPECT_EQ(judge({good}, {"a"}), Verdict::Pass);
    EXPECT_EQ(judge({good, step("b", kNaN, kNaN)}, {"a", "b"}), Verdict::Indeterminate);
    EXPECT_EQ(judge({good}, {"a", "b"}), Verdict::Indeterminate);
    EXPECT_EQ(judge({}, {}), Verdict::Indeterminate);
    EXPECT_EQ(judge({good, step("b", 0.3, 1)}, {"a", "b"}), Verdict::Fail);
    EXPECT_EQ(judge({good, step("b", 0.2, 3)}, {"a", "b"}), Verdict::Fail);
}

TEST(TransitionsProtocol, UnmeasuredTrainsMakeChangesIndeterminate) {
    RecordProperty("hazard", "H9");
    CapturedChange good{.name = "a", .from_v = 10, .to_v = 11, .from_s = 1, .to_s = 1, .before_v = {10, 10.001}};
    good.trains = {{kNaN, 11, 1, 1e-6, 1e-3, 1, 0}};
    good.measured = {.trains = 1, .complete_s = 1};
    good.fastest = {.trains = 1, .complete_s = 1};
    const auto judge = [](const std::vector<CapturedChange>& changes, const std::vector<std::string>& names = {}) {
        return judgeChanges(changes, names, {kWantedPerTrain}).verdict;
    };
    const auto but = [&good](const std::function<void(CapturedChange&)>& alter) {
        auto other = good;
        alter(other);
        return other;
    };
    const auto slow = [&](double trains) {
        return but([trains](CapturedChange& change) {
            change.measured = {.trains = trains, .complete_s = 9};
            change.fastest = {.trains = 8, .complete_s = 8};
        });
    };
    for (const auto& passed : {good, slow(8)}) EXPECT_EQ(judge({passed}), Verdict::Pass);
    EXPECT_EQ(judge({}), Verdict::Indeterminate);
    EXPECT_EQ(judge({good}, {"a", "b"}), Verdict::Indeterminate);
    for (const auto& open : {but([](auto& change) { change.trains[0].amplitude_jnd = kNaN; }),
                             but([](auto& change) { change.trains[0].onsetUncertainty_s = kNaN; }),
                             but([](auto& change) { change.before_v = {10}; }),
                             but([](auto& change) { change.measured.complete_s = kNaN; }),
                             but([](auto& change) { change.trains[0].amplitude_jnd = 1.999; })})
        EXPECT_EQ(judge({open}), Verdict::Indeterminate);
    for (const auto& failed : {but([](auto& change) { change.trains[0].interval_jnd = 2.2; }),
                               but([](auto& change) { change.measured.complete_s = 2.1; }), slow(9)})
        EXPECT_EQ(judge({failed}), Verdict::Fail);
}

TEST(TransitionsProtocol, SameSeedSameMoments) {
    const auto phases = [](std::uint64_t seed) {
        std::string out;
        const auto outcome = sweep("sim:", {{"repeats", "2"}}, seed);
        for (const auto& step : outcome.results["steps"])
            out += step["name"].get<std::string>() + step["since_onset_s"].dump();
        return out;
    };
    const auto first = phases(4);
    EXPECT_FALSE(first.empty());
    EXPECT_EQ(first, phases(4));
    EXPECT_NE(first, phases(5));
}

TEST(TransitionsProtocol, ReportsTheMapAndTheTables) {
    RunBench rig(true, "sim:", 1, true, kNeeded);
    const auto outcome = runProtocol(rig.shipped("transitions", {{"repeats", "1"}})).value();
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    rig.closeBench();
    ASSERT_TRUE(rig.writer().close());
    const auto reader = SessionReader::open(rig.folder().path() / "run.tacto").value();
    int maps = 0, tables = 0;
    const auto rows = reader.reportItems().value();
    for (const auto& row : rows) {
        maps += row.body.value("figure", nlohmann::json::object()).value("type", "") == "transitions" ? 1 : 0;
        tables += row.body.value("kind", "") == "results" ? 1 : 0;
    }
    EXPECT_EQ(maps, 1);
    EXPECT_EQ(tables, 1) << "those of its kind";
    EXPECT_EQ(reader.trials().value().size(), 4U + 4U + 12U);
}

/// Devices fail while the reference is checked and while steps are measured.
class TransitionsFault : public ::testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(TransitionsFault, EndsWithOutputsOffAndKeepsWhatThereWas) {
    RecordProperty("hazard", "H2");
    const auto [device, at_s] = GetParam();
    RunBench rig(true, fmt::format("sim:{}@{}s", device, at_s), 1, false, kNeeded);
    const auto outcome = runProtocol(rig.shipped("transitions", {{"repeats", "3"}})).value();
    ASSERT_TRUE(outcome.error);
    EXPECT_TRUE(rig.outputOff());
    EXPECT_NE(outcome.verdict, ScriptVerdict::Pass);
    ASSERT_TRUE(outcome.results.is_object()) << outcome.error->message;
    EXPECT_TRUE(outcome.results["partial"].get<bool>());
    EXPECT_TRUE(outcome.results["verdict"].is_null()) << outcome.results["verdict"];
    EXPECT_EQ(outcome.results["transitions"]["verdict"], "fail");
    EXPECT_EQ(outcome.results["steps"].empty(), at_s < 6);
}

INSTANTIATE_TEST_SUITE_P(AtEachStep, TransitionsFault,
                         ::testing::Combine(::testing::Values("stimulator?fault=unplug", "stimulator?fault=open",
                                                              "oscilloscope?fault=unplug", "oscilloscope?fault=stale"),
                                            ::testing::Values(0.0, 2.0, 20.0, 35.3)));

class TransitionsCancel : public ::testing::TestWithParam<int> {};

TEST_P(TransitionsCancel, EndsWithOutputsOffAndKeepsWhatThereWas) {
    RecordProperty("hazard", "H2");
    RunBench rig(true, "sim:", 1, false, kNeeded);
    const auto outcome = rig.stoppedAt(GetParam(), "transitions", {{"repeats", "3"}});
    ASSERT_TRUE(outcome.results.is_object());
    EXPECT_TRUE(outcome.results["partial"].get<bool>());
}

INSTANTIATE_TEST_SUITE_P(AtEachStep, TransitionsCancel, ::testing::Values(1, 5, 11));

}  // namespace
}  // namespace tacto
