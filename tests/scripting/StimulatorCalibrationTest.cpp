// The stimulator calibration as a laboratory starts it, on simulated devices with known errors and with faults.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/JsonText.h"
#include "core/results/ResultTable.h"
#include "core/session/SessionReader.h"
#include "tests/scripting/DataHome.h"
#include "tests/scripting/RunBench.h"

namespace tacto {
namespace {

using test::RunBench;
using testing::HasSubstr;
using Settings = std::map<std::string, std::string>;

constexpr const char* kName = "stimulator-calibration";
const std::set<Role> kNeeded{Role::Stimulator, Role::Oscilloscope};

ScriptOutcome calibrate(const std::string& device, const Settings& settings, std::uint64_t seed = 1) {
    RunBench rig(true, device, seed, true, kNeeded);
    auto outcome = runProtocol(rig.shipped(kName, settings)).value();
    EXPECT_TRUE(rig.outputOff());
    return outcome;
}

TEST(StimulatorCalibration, FindsGainAndOffsetOfATwin) {
    const auto outcome = calibrate("sim:stimulator?gain=1.01&offset=0.1V&flaws=none", {{"quantities", "amplitude"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& amplitude = outcome.results["amplitude"];
    EXPECT_NEAR(amplitude["gain"].get<double>(), 1.01, 0.006);
    EXPECT_NEAR(amplitude["offset"].get<double>(), 0.1, 0.02);
    EXPECT_EQ(amplitude["unit"], "V");
    EXPECT_EQ(amplitude["n"], 110);
    EXPECT_EQ(amplitude["levels"].size(), 11U);
    // 1 % plus 0.1 V of 10 V is 2 %, exactly the tolerance, so the verdict is open.
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Indeterminate);
    EXPECT_EQ(amplitude["verdict_iec"], "pass");
    EXPECT_TRUE(outcome.results["reference"]["passed"].get<bool>());
}

TEST(StimulatorCalibration, OfEverythingOnAHealthyTwinPasses) {
    const auto outcome = calibrate("sim:", {});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Pass) << outcome.results["reasons"].dump();
    for (const char* quantity : {"amplitude", "interval", "width", "gap"}) {
        const auto& found = outcome.results[quantity];
        EXPECT_NEAR(found["gain"].get<double>(), 1, quantity == std::string_view("amplitude") ? 0.012 : 0.001)
            << quantity;
        for (const char* key :
             {"offset", "residual_max_pct_fs", "repeatability_pct_fs", "hysteresis_pct_fs", "expanded_uncertainty"}) {
            EXPECT_TRUE(found[key].is_number()) << quantity << "." << key;
        }
        EXPECT_EQ(found["verdict"], "pass") << quantity;
        EXPECT_EQ(found["levels"].size(), 11U) << quantity;
        EXPECT_EQ(found["not_measured"], 0) << quantity;
    }
}

TEST(StimulatorCalibration, OfATwinThatIsOffFails) {
    RecordProperty("hazard", "H9");
    const auto outcome = calibrate("sim:stimulator?gain=1.05", {{"quantities", "amplitude"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Fail);
    EXPECT_THAT(outcome.reasons.front(), HasSubstr(", tolerance"));
}

TEST(StimulatorCalibration, OfACurrentSourceIsInMilliamps) {
    const auto outcome =
        calibrate("sim:stimulator?mode=current&gain=1.02", {{"quantities", "amplitude"}, {"repeats", "3"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& amplitude = outcome.results["amplitude"];
    EXPECT_EQ(amplitude["unit"], "mA");
    EXPECT_EQ(amplitude["levels"].size(), 11U);
    EXPECT_NEAR(amplitude["gain"].get<double>(), 1.02, 0.01);
    EXPECT_NEAR(amplitude["full_scale"].get<double>(), 40, 1);
}

TEST(StimulatorCalibration, AFailedKnownReferenceCalibratesNothing) {
    RecordProperty("hazard", "H9");
    const auto outcome = calibrate("sim:stimulator?load=1.1kohm", {});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Indeterminate);
    ASSERT_FALSE(outcome.reasons.empty());
    EXPECT_THAT(outcome.reasons.front(), HasSubstr("known-reference check failed"));
    EXPECT_FALSE(outcome.results.contains("amplitude"));
}

TEST(StimulatorCalibration, TheSameSeedGivesTheSameSweepsAndAnotherSeedOthers) {
    const auto directions = [](std::uint64_t seed) {
        const auto outcome = calibrate("sim:", {{"quantities", "amplitude"}, {"levels", "2"}, {"repeats", "8"}}, seed);
        std::string order;
        for (const auto& reading : outcome.results["amplitude"]["readings"])
            order += reading["direction"].get<std::string>();
        return order;
    };
    const auto first = directions(4);
    EXPECT_FALSE(first.empty());
    EXPECT_EQ(first, directions(4));
    EXPECT_NE(first, directions(5));
}

TEST(StimulatorCalibration, ARangeThatIsNoneIsRefused) {
    const auto outcome = calibrate("sim:", {{"amplitude_min_v", "40"}, {"amplitude_max_v", "20"}});
    ASSERT_TRUE(outcome.error);
    EXPECT_THAT(outcome.error->message, HasSubstr("amplitude_min_v is 40"));
}

TEST(StimulatorCalibration, AnOscilloscopeThatStatesNothingAsksForItsDataSheet) {
    RecordProperty("hazard", "H9");
    const auto silent = calibrate("sim:oscilloscope?accuracy=unknown", {{"quantities", "amplitude"}});
    ASSERT_FALSE(silent.error) << silent.error->message;
    EXPECT_EQ(silent.verdict, ScriptVerdict::Indeterminate);
    EXPECT_THAT(silent.reasons.front(), HasSubstr("the known-reference check was not evaluated"));
    EXPECT_FALSE(silent.results.contains("amplitude"));
    const auto stated = calibrate("sim:oscilloscope?accuracy=unknown",
                                  {{"quantities", "amplitude"}, {"repeats", "2"}, {"scope_gain_pct", "1"}});
    ASSERT_FALSE(stated.error) << stated.error->message;
    EXPECT_NEAR(stated.results["amplitude"]["budget"]["rows"][1]["value"].get<double>(), 0.01, 1e-9);
}

TEST(StimulatorCalibration, TheSessionHoldsEveryReadingAndTheReportItsFigures) {
    RecordProperty("hazard", "H8");
    RunBench rig(true, "sim:", 1, true, kNeeded);
    const auto outcome =
        runProtocol(rig.shipped(kName, {{"quantities", "amplitude"}, {"levels", "3"}, {"repeats", "2"}})).value();
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    rig.closeBench();
    ASSERT_TRUE(rig.writer().close());
    const auto reader = SessionReader::open(rig.folder().path() / "run.tacto").value();
    EXPECT_EQ(reader.trials().value().size(), 12U);
    int figures = 0, budgets = 0;
    const auto rows = reader.reportItems().value();
    for (const auto& row : rows) {
        const auto& item = row.body;
        figures += item.value("figure", nlohmann::json::object()).value("type", "") == "calibration" ? 1 : 0;
        const auto& amplitude = memberAt(item, "results.amplitude");
        for (const char* end : {"budget", "budget_smallest"}) budgets += !memberAt(amplitude, end).is_null();
    }
    EXPECT_EQ(figures, 1) << "error and both directions in one";
    EXPECT_EQ(budgets, 2) << "of the largest and of the smallest command";
}

using CalibrationKept = test::DataHome;  // a separate store for each test

TEST_F(CalibrationKept, IsCheckedByAShortRunAndNoticesThatTheStimulatorChanged) {
    RecordProperty("hazard", "H9");
    const auto nothing = calibrate("sim:", {{"mode", "check"}});
    ASSERT_TRUE(nothing.error);
    EXPECT_THAT(nothing.error->message, HasSubstr("SIM-1 is not calibrated"));

    const auto full = calibrate("sim:stimulator?gain=1.03", {{"store", "true"}});
    ASSERT_FALSE(full.error) << full.error->message;
    EXPECT_EQ(full.results["stored"]["serial"], "SIM-1");
    EXPECT_TRUE(full.results["stored"]["supersedes"].is_null());

    const auto holds = calibrate("sim:stimulator?gain=1.03", {{"mode", "check"}});
    ASSERT_FALSE(holds.error) << holds.error->message;
    EXPECT_EQ(holds.verdict, ScriptVerdict::Pass) << holds.results["reasons"].dump();
    const auto changed = calibrate("sim:stimulator?gain=0.98", {{"mode", "check"}});
    ASSERT_FALSE(changed.error) << changed.error->message;
    EXPECT_EQ(changed.verdict, ScriptVerdict::Fail);
    EXPECT_EQ(changed.reasons.size(), 3U);
    // A phase that is 1.5 us longer, at 100 to 400 us: 1 % is allowed, so 100 us fails.
    const auto longer = calibrate("sim:stimulator?gain=1.03&widtherror=1.5us", {{"mode", "check"}});
    ASSERT_FALSE(longer.error) << longer.error->message;
    EXPECT_EQ(longer.verdict, ScriptVerdict::Fail);
    EXPECT_THAT(longer.reasons.front(), HasSubstr("Phase width: at 100.0 µs the stored calibration expects"));
    EXPECT_EQ(longer.results["check"].size(), 12U) << "three levels of each of the four";
}

TEST_F(CalibrationKept, IsKeptOfAllFourOnly) {
    RecordProperty("hazard", "H9");
    const auto some = calibrate("sim:", {{"quantities", "amplitude"}, {"store", "true"}});
    ASSERT_TRUE(some.error);
    EXPECT_THAT(some.error->message, HasSubstr("quantities is amplitude; all is expected to keep a result"));
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(CalibrationKept, RefusesAnIncompleteOneAndAnOverdueOscilloscope) {
    RecordProperty("hazard", "H9");
    const Settings kept{{"store", "true"}, {"repeats", "2"}};
    auto few = kept, overdue = Settings{{"store", "true"}};
    few["levels"] = "5";
    overdue["scope_due"] = "2020-01-01";
    const auto incomplete = calibrate("sim:", few);
    ASSERT_TRUE(incomplete.error);
    EXPECT_THAT(incomplete.error->message, HasSubstr("a complete calibration"));
    const auto late = calibrate("sim:", overdue);
    ASSERT_TRUE(late.error);
    EXPECT_THAT(late.error->message, HasSubstr("was itself due on 2020-01-01"));
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

/// Returns the certificate item of a run's report; null if the report is not a certificate.
nlohmann::json certificateOf(const std::string& device, const Settings& settings) {
    RunBench rig(true, device, 1, true, kNeeded);
    const auto outcome = runProtocol(rig.shipped(kName, settings)).value();
    EXPECT_FALSE(outcome.error) << outcome.error->message;
    rig.closeBench();
    EXPECT_TRUE(rig.writer().close());
    const auto reader = SessionReader::open(rig.folder().path() / "run.tacto").value();
    nlohmann::json item;
    const auto rows = reader.reportItems().value();
    for (const auto& row : rows)
        if (textOr(row.body, "kind") == "certificate") item = row.body;
    return item;
}

/// The delivered value of the simulated stimulator is known: gain · command. So is its value with another correction.
TEST_F(CalibrationKept, ItsCertificateSaysWhatWasFoundAndWhatIsLeft) {
    RecordProperty("hazard", "H9");
    const auto errors = [](const nlohmann::json& item, const char* key, double share) {
        const auto& amplitude = item["quantities"][0];
        EXPECT_EQ(amplitude["quantity"], "amplitude");
        ASSERT_EQ(amplitude[key].size(), 11U) << key;
        for (const auto& row : amplitude[key]) {
            const double u = row["expanded_uncertainty"];
            EXPECT_NEAR(row["error"].get<double>(), share * row["commanded"].get<double>(), u) << key << row;
            EXPECT_GT(row["coverage_factor"].get<double>(), 1.5);
            EXPECT_LT(u, 0.01 * row["commanded"].get<double>());
        }
    };
    const auto first = certificateOf("sim:stimulator?gain=1.03&flaws=none", {{"store", "true"}});
    ASSERT_EQ(first["quantities"].size(), 4U);
    errors(first, "measured", 0.03);
    EXPECT_TRUE(first["quantities"][0]["found"].is_null()) << "no correction was stored before";
    EXPECT_TRUE(first["before"]["made"].is_null());
    errors(first, "left", 0);
    EXPECT_TRUE(first["kept"].is_object());

    const auto moved = certificateOf("sim:stimulator?gain=1.05&flaws=none", {});
    errors(moved, "measured", 0.05);
    errors(moved, "found", 1.05 / 1.03 - 1);
    EXPECT_TRUE(moved["quantities"][0]["left"].is_null()) << "nothing was stored by this run";
    EXPECT_TRUE(moved["kept"].is_null());
    EXPECT_TRUE(moved["before"]["made"].is_string());

    const auto again = certificateOf("sim:stimulator?gain=1.05&flaws=none", {{"store", "true"}});
    errors(again, "found", 1.05 / 1.03 - 1);
    errors(again, "left", 0);
    EXPECT_TRUE(certificateOf("sim:stimulator?gain=1.05&flaws=none", {{"mode", "check"}}).is_null())
        << "a check does not calibrate";
}

TEST_F(CalibrationKept, ACertificateIsOfTheRunsOwnReadingsAlone) {
    RecordProperty("hazard", "H8");
    const auto refused = [](const std::string& call) {
        RunBench rig(true, "sim:", 1, true, kNeeded);
        const auto outcome = rig.run(test::withRun(call + " return verdict({ verdict: null });"));
        return outcome.error ? outcome.error->message : std::string("was accepted");
    };
    EXPECT_THAT(
        refused("report.certificate([{ quantity: 'amplitude', calibration: 1, levels: [] }], bench.calibration);"),
        HasSubstr("made of this run's own readings"));
    EXPECT_THAT(refused("report.certificate([], { calibrated: true, text: 'made up', made: '2026-01-01' });"),
                HasSubstr("bench.calibration, unchanged"));
}

/// Devices fail at every step in turn: during the reference check, the warm-up, and the levels of amplitude, interval,
/// width and gap (the virtual clock makes the times the same in every run).
class CalibrationFault : public ::testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(CalibrationFault, EndsWithOutputsOffAndKeepsWhatThereWas) {
    RecordProperty("hazard", "H2");
    const auto [device, at_s] = GetParam();
    RunBench rig(true, fmt::format("sim:{}@{}s", device, at_s), 1, false, kNeeded);
    const auto outcome = runProtocol(rig.shipped(kName, {{"repeats", "2"}, {"levels", "4"}})).value();
    ASSERT_TRUE(outcome.error);
    EXPECT_TRUE(rig.outputOff());
    EXPECT_NE(outcome.verdict, ScriptVerdict::Pass);
    if (at_s < 15) return;  // nothing was read by then
    ASSERT_TRUE(outcome.results.is_object()) << outcome.error->message;
    EXPECT_TRUE(outcome.results["partial"].get<bool>());
    EXPECT_GE(outcome.results["amplitude"]["readings"].size(), 4U);
    EXPECT_TRUE(outcome.results["verdict"].is_null());
}

INSTANTIATE_TEST_SUITE_P(AtEachStep, CalibrationFault,
                         ::testing::Combine(::testing::Values("stimulator?fault=unplug", "stimulator?fault=open",
                                                              "oscilloscope?fault=unplug", "oscilloscope?fault=stale"),
                                            ::testing::Values(0.0, 5.0, 18.0, 30.0, 57.2, 57.5)));

/// The operator stops at the n-th reading.
class CalibrationCancel : public ::testing::TestWithParam<int> {};

TEST_P(CalibrationCancel, EndsWithOutputsOffAndKeepsWhatThereWas) {
    RecordProperty("hazard", "H2");
    RunBench rig(true, "sim:", 1, false, kNeeded);
    const auto outcome = rig.stoppedAt(GetParam(), kName, {{"repeats", "2"}, {"levels", "4"}});
    ASSERT_EQ(outcome.results.is_object(), GetParam() > 4) << outcome.results.dump();
    if (outcome.results.is_object()) {
        EXPECT_TRUE(outcome.results["partial"].get<bool>());
    }
}

INSTANTIATE_TEST_SUITE_P(AtEachStep, CalibrationCancel, ::testing::Values(1, 7, 17, 40, 55));

}  // namespace
}  // namespace tacto
