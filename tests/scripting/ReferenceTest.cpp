// The preparations for a procedure: the wiring, and a known load that must read correctly.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/session/SessionReader.h"
#include "tests/scripting/RunBench.h"

namespace tacto {
namespace {

using test::RunBench;
using test::withRun;

constexpr const char* kRead =
    "bench.arm({ load: 1000 }); bench.drive('manual', { roughness: 1, pressure: 1 });"
    "const reading = measure.pulse(bench.capture({ trains: 1 })); bench.disarm();";

/// Returns the report items of one kind from a run with a closed session.
std::vector<nlohmann::json> reported(const RunBench& rig, std::string_view kind) {
    std::vector<nlohmann::json> out;
    const auto reader = SessionReader::open(rig.folder().path() / "run.tacto").value();
    const auto rows = reader.reportItems().value();
    for (const auto& row : rows) {
        if (row.body.value("kind", "") == kind) out.push_back(row.body);
    }
    return out;
}

TEST(KnownReference, OfTheLoadThatIsConnectedPassesAndIsRecorded) {
    RunBench rig(true, "sim:", 3, true);
    const auto outcome = rig.run(withRun(
        std::string(kRead) + "return verdict(Object.assign({ verdict: null }, record.reference(reading, 1000, 1)));"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.results["passed"], true);
    EXPECT_NEAR(outcome.results["measured_ohm"].get<double>(), 1000, 30);
    EXPECT_NEAR(outcome.results["deviation_pct"].get<double>(),
                outcome.results["measured_ohm"].get<double>() / 10 - 100, 1e-9);
    EXPECT_EQ(outcome.results["allowed_pct"].get<double>(), 1) << "the instruments' part is in U, which narrows it";
    // Shunt (0.1 %), linearity and steps; the gain error that both channels share (0.5 %) cancels.
    EXPECT_GT(outcome.results["expanded_uncertainty_pct"].get<double>(), 0.1);
    EXPECT_LT(outcome.results["expanded_uncertainty_pct"].get<double>(), 0.4);
    EXPECT_TRUE(outcome.results["reason"].is_null());
    rig.closeBench();
    ASSERT_TRUE(rig.writer().close());
    const auto tables = reported(rig, "table");
    ASSERT_EQ(tables.size(), 1U);
    EXPECT_EQ(tables[0]["caption"], "Known-reference check");
    const auto& row = tables[0]["rows"][0];
    EXPECT_EQ(row["verdict"], "pass");
    EXPECT_EQ(row["Read as"]["unit"], "ohm") << "one column with its uncertainty, not one for each key";
    EXPECT_GT(row["Read as"]["expanded"].get<double>(), 1);
    EXPECT_EQ(tables[0]["columns"].back(), "verdict");
}

TEST(KnownReference, OfAnotherLoadOrOfNoneFailsWithItsReason) {
    RunBench rig;
    const auto reasonOf = [&](const std::string& call) {
        const auto outcome =
            rig.run(withRun(std::string(kRead) + "return verdict(Object.assign(" + call + ", { verdict: null }));"));
        EXPECT_FALSE(outcome.error) << outcome.error->message;
        EXPECT_EQ(outcome.results["passed"], false) << call;
        return outcome.results["reason"].is_string() ? outcome.results["reason"].get<std::string>() : "none";
    };
    EXPECT_THAT(reasonOf("record.reference(reading, 2000, 1)"),
                testing::MatchesRegex("the known-reference check failed: .* ± .* ohm was measured where 2000 ohm is "
                                      "connected; 1 % of it is accepted, uncertainty included"));
    EXPECT_THAT(reasonOf("record.reference({}, 2000, 1)"), testing::HasSubstr("nothing was measured where 2000 ohm"));
    EXPECT_THAT(reasonOf("record.reference({ load_ohm: NaN, load_expanded_ohm: NaN }, 2000, 1)"),
                testing::HasSubstr("nothing was measured"));
    const auto refused = rig.run(withRun("record.reference({}, 0, 1)"));
    ASSERT_TRUE(refused.error);
    EXPECT_THAT(refused.error->message, testing::HasSubstr("load is 0"));
}

TEST(KnownReference, WhatItsUncertaintyLeavesOpenIsNoFailure) {
    RecordProperty("hazard", "H9");
    RunBench rig(true, "sim:", 3, true);
    const auto outcome = rig.run(withRun(R"(
        const of = (ohm, u) => record.reference({ load_ohm: ohm, load_expanded_ohm: u }, 1000, 5);
        return verdict({ verdict: null, inside: of(1020, 20), open: of(1045, 20), outside: of(1200, 20),
            unknown: of(1045, null), none: of(null, null) });)"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto says = [&](const char* which) {
        const auto& check = outcome.results[which];
        EXPECT_EQ(check["passed"], check["verdict"] == "pass") << which;
        EXPECT_EQ(check["reason"].is_null(), check["verdict"] == "pass") << which;
        return check["verdict"].get<std::string>() + "; " + check["reason"].dump();
    };
    EXPECT_THAT(says("inside"), testing::StartsWith("pass"));
    EXPECT_THAT(says("open"), testing::MatchesRegex("indeterminate; .*check is indeterminate: .*"));
    EXPECT_THAT(says("outside"), testing::MatchesRegex("fail; .*check failed: .*"));
    EXPECT_THAT(says("unknown"), testing::MatchesRegex("not evaluated; .*check was not evaluated: .*"));
    EXPECT_THAT(says("none"), testing::MatchesRegex("not evaluated; .*check was not evaluated: nothing .*"));
    rig.closeBench();
    ASSERT_TRUE(rig.writer().close());
    std::vector<std::string> reportedVerdicts;
    for (const auto& table : reported(rig, "table")) reportedVerdicts.push_back(table["rows"][0]["verdict"]);
    EXPECT_THAT(reportedVerdicts,
                testing::ElementsAre("pass", "indeterminate", "fail", "not evaluated", "not evaluated"));
}

TEST(KnownReference, ReadAndJudgedInOneCallLeavesTheOutputArmedUnlessItFails) {
    RecordProperty("hazard", "H12");
    RunBench rig;
    const auto outcome =
        rig.run(withRun(std::string(kRead) +
                        "const known = bench.readKnownLoad(1000, 5), state = bench.live().state;"
                        "return verdict({ verdict: null, known, apart: record.reference(reading, 1000, 5), state });"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& known = outcome.results["known"];
    EXPECT_EQ(known["passed"], true) << known;
    EXPECT_EQ(known["allowed_pct"], 5);
    EXPECT_NEAR(known["measured_ohm"].get<double>(), outcome.results["apart"]["measured_ohm"].get<double>(), 10);
    EXPECT_EQ(outcome.results["state"], "delivering");
    const auto refused = rig.run(withRun("bench.arm(); bench.readKnownLoad(1000, 500);"));
    ASSERT_TRUE(refused.error);
    EXPECT_EQ(rig.bench().telemetry().state, InterlockState::Disarmed);
}

TEST(Wiring, OfASimulatedBenchIsReportedWithoutAQuestion) {
    RunBench rig(true, "sim:", 3, true);
    const auto outcome = rig.run(withRun("operator.wired(500); operator.wired();"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    rig.closeBench();
    ASSERT_TRUE(rig.writer().close());
    const auto texts = reported(rig, "text");
    ASSERT_EQ(texts.size(), 2U);
    EXPECT_THAT(texts[0]["text"].get<std::string>(), testing::HasSubstr("simulated bench"));
}

/// A run on a bench that looks real, with the names of the questions to its technician.
struct LabRun {
    ScriptOutcome outcome;
    std::vector<std::string> asked;
    bool outputOff = false;
    std::string drawing;  // the drawing in the first question
};

LabRun inTheLab(const std::string& protocol, const std::map<std::string, std::string>& settings) {
    RunBench rig(true, "sim:", 1, false, {Role::Stimulator, Role::Oscilloscope}, true);
    LabRun run;
    run.outcome = runProtocol(rig.shipped(protocol, settings)).value();
    for (const auto& question : rig.technician().asked) run.asked.push_back(question.name);
    if (!rig.technician().asked.empty()) run.drawing = rig.technician().asked.front().drawing;
    run.outputOff = rig.outputOff();
    return run;
}

class InALab : public testing::TestWithParam<std::pair<const char*, std::map<std::string, std::string>>> {};

TEST_P(InALab, TheWiringIsAskedForBeforeAnythingIsDelivered) {
    const auto& [protocol, settings] = GetParam();
    const auto run = inTheLab(protocol, settings);
    ASSERT_FALSE(run.outcome.error) << run.outcome.error->message;
    ASSERT_FALSE(run.asked.empty());
    EXPECT_EQ(run.asked.front(), "wiring");
    EXPECT_EQ(std::count(run.asked.begin(), run.asked.end(), "wiring"), 1);
    EXPECT_EQ(run.drawing, "wiring");
    EXPECT_TRUE(run.outputOff);
    EXPECT_TRUE(run.outcome.results.is_object());
}

using Settings = std::map<std::string, std::string>;
INSTANTIATE_TEST_SUITE_P(
    Protocols, InALab,
    testing::Values(std::pair("transitions", Settings{{"repeats", "1"}}),
                    std::pair("encoding-comparison", Settings{{"repeats", "5"}, {"level_repeats", "2"}}),
                    std::pair("stimulator-calibration",
                              Settings{{"quantities", "amplitude"}, {"levels", "3"}, {"repeats", "2"}}),
                    std::pair("load-safety", Settings{{"area", "3"}, {"steps", "2"}})),
    [](const auto& one) {
        std::string name = one.param.first;
        std::replace(name.begin(), name.end(), '-', '_');
        return name;
    });

TEST(LabBench, TheTechnicianFitsEveryLoadOfTheSafetyCheckAndItIsTheSameCheck) {
    RecordProperty("hazard", "H1");
    const Settings settings{{"area", "3"}, {"steps", "2"}};
    const auto lab = inTheLab("load-safety", settings);
    ASSERT_FALSE(lab.outcome.error) << lab.outcome.error->message;
    EXPECT_GE(std::count(lab.asked.begin(), lab.asked.end(), "fit-load"), 5);
    RunBench twin(true, "sim:", 1, false, {Role::Stimulator, Role::Oscilloscope});
    const auto alone = runProtocol(twin.shipped("load-safety", settings)).value();
    EXPECT_EQ(lab.outcome.verdict, alone.verdict);
    const auto rowsOf = [](const nlohmann::json& results) {
        std::vector<std::string> rows;
        for (const auto& row : results["rows"]) {
            rows.push_back(row.value("item", "") + " " + row.value("verdict", row.value("status", "")));
        }
        return rows;
    };
    EXPECT_EQ(rowsOf(lab.outcome.results), rowsOf(alone.results));
    EXPECT_FALSE(rowsOf(alone.results).empty());
}

}  // namespace
}  // namespace tacto
