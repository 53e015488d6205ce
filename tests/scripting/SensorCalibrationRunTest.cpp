// The sensor calibration on the simulated bench: its results, its refusals, and what happens if something breaks or the
// operator stops it.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/bench/Profile.h"
#include "core/dsp/RoughnessAnalysis.h"
#include "core/session/SessionReader.h"
#include "tests/scripting/DataHome.h"
#include "tests/scripting/RunBench.h"
#include "tests/support/InTime.h"

namespace tacto {
namespace {

using test::RunBench;
using testing::HasSubstr;
using Settings = std::map<std::string, std::string>;

const std::set<Role> kSensorBench{Role::Sensor};
/// The shortest calibration: two surfaces, three slides, no weights.
const Settings kShort{{"more", ""}, {"slides", "3"}, {"duration_s", "2"}, {"weights_g", ""}};

Settings with(Settings settings, const Settings& changes) {
    for (const auto& [key, value] : changes) settings[key] = value;
    return settings;
}

ScriptOutcome calibrateSensor(const std::string& device, const Settings& settings, std::uint64_t seed = 1) {
    RunBench rig(true, device, seed, false, kSensorBench);
    auto outcome = runProtocol(rig.shipped("sensor-calibration", settings)).value();
    EXPECT_TRUE(rig.outputOff());
    return outcome;
}

TEST(SensorCalibrationRun, FindsScalesRankingForceAndTaxelsOfTheTwin) {
    const auto outcome = calibrateSensor("sim:", {});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Pass) << outcome.results["reasons"].dump();
    const auto& results = outcome.results;
    ASSERT_EQ(results["surfaces"].size(), 6U);
    EXPECT_EQ(results["surfaces"][1]["name"], "P120");
    EXPECT_EQ(results["surfaces"][1]["rz_um"], 290);
    EXPECT_NEAR(results["surfaces"][1]["h"].get<double>(), kSimulatedH.rough, 0.1 * kSimulatedH.rough);
    EXPECT_NEAR(results["surfaces"][0]["v"].get<double>(), kSimulatedVStatic.smooth, 0.15 * kSimulatedVStatic.smooth);
    for (const char* key : {"h", "v", "R"}) {
        EXPECT_TRUE(results["d_prime"][key]["told_apart"].get<bool>()) << key;
        EXPECT_GT(results["d_prime"][key]["low"].get<double>(), 1) << key;
    }
    EXPECT_GE(results["spearman"]["value"].get<double>(), 0.9);
    EXPECT_EQ(results["spearman"]["n"], 6);
    // The simulated sensors are accurate: 1 N reads 1 N, and 1 Pa reads 1 Pa on the average taxel.
    EXPECT_NEAR(results["force"]["scale"].get<double>(), 1, 0.01);
    EXPECT_NEAR(results["force"]["offset"].get<double>(), 0, 0.02);
    ASSERT_EQ(results["taxels"].size(), 8U);
    double sum = 0;
    for (const auto& taxel : results["taxels"]) sum += taxel["scale"].get<double>();
    EXPECT_NEAR(sum / 8, 1, 0.02);
    EXPECT_TRUE(results["reference"]["passed"].get<bool>());
    EXPECT_FALSE(results.contains("partial"));
}

TEST(SensorCalibrationRun, ItsProfileMakesRCalibratedFromThenOn) {
    RecordProperty("hazard", "H7");
    RunBench rig(true, "sim:", 1, false, kSensorBench);
    const auto outcome =
        runProtocol(rig.shipped("sensor-calibration", with(kShort, {{"contact_area_cm2", "0.8"}}))).value();
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& kept = outcome.results["profile"];
    EXPECT_TRUE(kept["file"].is_null());
    const auto profile = parseProfile(kept["profile"].dump(), "the result").value();
    EXPECT_TRUE(profile.roughness.calibrated);
    EXPECT_TRUE(profile.roughness.restMeanSquare);
    EXPECT_EQ(profile.roughness.contactArea, SquareCentimetres(0.8));
    EXPECT_EQ(profile.roughness.roughSurface->name, "P120");
    EXPECT_THAT(profile.name, HasSubstr("SIM-1"));
    EXPECT_EQ(rig.bench().profile().roughness, profile.roughness) << "in force for the rest of the run";
}

/// A simulated fingertip with a force sensor that reads 0.8 N for 1 N, and taxels that read 2.5 counts for 1 Pa.
constexpr const char* kWrongTwin = "sim:finger?forcegain=0.8&taxelgain=2.5&taxelunit=count";
const Settings kWeighed{{"weights_g", "50; 200; 500"},
                        {"weight_repeats", "2"},
                        {"reference_tolerance_pct", "30"},
                        {"contact_area_tolerance_pct", "5"}};

/// Returns the bench's pressure for 2 N on the fingertip's square centimetre.
double pressureUnder2N(RunBench& rig) {
    EXPECT_TRUE(rig.bench().devices().surface->present("glass", MillimetresPerSecond(0), Newtons(2)));
    EXPECT_TRUE(rig.bench().wait(Seconds(1)));
    std::vector<double> seen;
    for (int i = 0; i < 50; ++i) {
        EXPECT_TRUE(rig.bench().wait(Seconds(0.02)));
        seen.push_back(rig.bench().telemetry().pressure_pa);
    }
    return statisticsOf(seen).mean;
}

/// Returns what the taxels alone read for 2.04 N, with a profile for a fingertip without a force sensor.
RoughnessSummary taxelsUnder208g(RunBench& rig, const RoughnessSettings& settings) {
    const auto outcome = rig.run(test::withRun("return verdict({ verdict: 'pass', at: bench.measureWeight(208) });"));
    EXPECT_FALSE(outcome.error);
    const auto reading = outcome.results["at"];
    SampleBlock block;
    for (int i = 0; i < 200; ++i) {
        block.t_s.push_back(i / 200.0);
        for (const auto& taxel : reading["taxels"]) block.values.push_back(taxel.get<double>());
    }
    const StreamInfo taxels{StreamKind::Taxels, StreamUnit::Count, 8, 200, "taxels"};
    return analyseRoughness({{taxels}}, {{block}}, settings).value().summary;
}

TEST(SensorCalibrationRun, ATwinWithWrongScalesGivesTheRightPressureAfterwardsAndTheWrongOneBefore) {
    RecordProperty("hazard", "H7");
    RunBench rig(true, kWrongTwin, 1, true, kSensorBench);
    EXPECT_NEAR(pressureUnder2N(rig), 0.8 * 20'000, 100) << "what the force sensor says";
    EXPECT_EQ(taxelsUnder208g(rig, {}).pressure_pa.n, 0U) << "counts are not pressure";
    const auto outcome = runProtocol(rig.shipped("sensor-calibration", with(kShort, kWeighed))).value();
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Pass) << outcome.results["reasons"].dump();
    const auto profile = parseProfile(outcome.results["profile"]["profile"].dump(), "the result").value();
    ASSERT_TRUE(profile.roughness.sensor);
    EXPECT_EQ(profile.roughness.sensor->fingertip, "SIM-1");
    EXPECT_NEAR(profile.roughness.sensor->force->scale, 1 / 0.8, 0.01);
    EXPECT_NEAR(pressureUnder2N(rig), 20'000, 200) << "in force for the rest of the run";
    EXPECT_THAT(rig.bench().telemetry().flags.texts(), testing::Each(testing::Not(HasSubstr("calibrated"))));
    const auto pressed = taxelsUnder208g(rig, profile.roughness);
    EXPECT_NEAR(pressed.pressure_pa.mean, 0.208 * 9.80665 / 1e-4, 200);
    EXPECT_THAT(pressed.flags, testing::Not(testing::Contains("uncalibrated units")));

    // The profile is tried in another run, and on another board.
    RunBench same(true, kWrongTwin, 1, false, kSensorBench), another(true, kWrongTwin, 2, false, kSensorBench);
    for (auto* bench : {&same, &another}) ASSERT_TRUE(bench->bench().setProfile(profile));
    EXPECT_NEAR(pressureUnder2N(same), 20'000, 200);
    EXPECT_NEAR(pressureUnder2N(another), 0.8 * 20'000, 100) << "scales of another fingertip are left aside";
    EXPECT_THAT(another.bench().telemetry().flags.texts(),
                testing::IsSupersetOf({"calibrated on another fingertip", "uncalibrated R"}));
}

TEST(SensorCalibrationRun, TheScalesCarryTheTolerancesOfWeightsGravityAndArea) {
    const auto outcome = calibrateSensor("sim:", with(kShort, kWeighed));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& force = outcome.results["force"];
    // 0.1 % and 0.27 %, rectangular, plus the scatter of the readings.
    EXPECT_NEAR(force["scale_expanded_uncertainty"].get<double>(), 1.96 * 0.288e-2 / std::sqrt(3.0), 1.5e-3);
    EXPECT_NEAR(outcome.results["taxels"][0]["scale_expanded_uncertainty"].get<double>(), 1.96 * 0.05 / std::sqrt(3.0),
                0.01);
    const auto& u = outcome.results["uncertainty_R"];
    EXPECT_GT(u["middle"].get<double>(), 0);
    EXPECT_LT(u["middle"].get<double>(), 0.3);
    EXPECT_GT(u["smooth"].get<double>(), u["middle"].get<double>())
        << "the references' own means count most at the ends";
    EXPECT_EQ(outcome.results["surfaces"][0]["R_expanded_uncertainty"].is_number(), true);
    auto unknown = with(kWeighed, {{"contact_area_tolerance_pct", "0"}});
    const auto without = calibrateSensor("sim:", with(kShort, unknown));
    EXPECT_TRUE(without.results["taxels"][0]["scale_expanded_uncertainty"].is_null()) << "not known is not 0";
    EXPECT_TRUE(without.results["force"]["scale_expanded_uncertainty"].is_number());
}

TEST(SensorCalibrationRun, WhoStartsTouchedIsToldSo) {
    // A finger that is never lifted: without a presenter, nothing else would notice that.
    RunBench rig(true, "sim:", 1, false, kSensorBench);
    rig.bench().devices().surface.reset();
    auto request = rig.request(test::withRun("bench.measureRest({ duration_s: 2 });"));
    PresetOperator desk(Settings{{"rest", "yes"}});
    request.operatorDesk = &desk;
    const auto outcome = runProtocol(std::move(request)).value();
    ASSERT_TRUE(outcome.error);
    EXPECT_THAT(outcome.error->message, HasSubstr("it was in contact"));
}

using SensorProfileKept = test::DataHome;  // a separate store for each test

TEST_F(SensorProfileKept, IsAFileThatALaterOneDoesNotOverwrite) {
    const auto settings = with(kShort, {{"store", "true"}});
    const auto first = calibrateSensor("sim:", settings), second = calibrateSensor("sim:", settings, 2);
    ASSERT_FALSE(first.error) << first.error->message;
    ASSERT_FALSE(second.error) << second.error->message;
    const auto one = first.results["profile"]["file"].get<std::string>();
    const auto two = second.results["profile"]["file"].get<std::string>();
    EXPECT_NE(one, two);
    const auto profile = loadProfile(one).value();
    EXPECT_TRUE(profile.roughness.calibrated);
    EXPECT_EQ(toJson(profile), first.results["profile"]["profile"]);
    EXPECT_NE(loadProfile(two).value().roughness, profile.roughness);
}

TEST_F(SensorProfileKept, IsNotWrittenForSurfacesThatCannotBeToldApart) {
    RecordProperty("hazard", "H7");
    // Two smooth surfaces, and taxels with much more noise than either surface causes.
    const auto outcome = calibrateSensor("sim:finger?taxelnoise=1000", with(kShort, {{"store", "true"},
                                                                                     {"smooth", "glass"},
                                                                                     {"smooth_ra_um", "0.01"},
                                                                                     {"smooth_rz_um", "0.07"},
                                                                                     {"rough", "plastic"},
                                                                                     {"rough_ra_um", "1.6"},
                                                                                     {"rough_rz_um", "11"},
                                                                                     {"duration_s", "1"}}));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Fail) << outcome.results["d_prime"].dump();
    ASSERT_FALSE(outcome.reasons.empty());
    EXPECT_THAT(outcome.reasons.front(), HasSubstr("v_static of the two references is d′"));
    EXPECT_TRUE(outcome.results["profile"].is_null());
    EXPECT_FALSE(outcome.results["roughness"]["calibrated"].get<bool>());
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST(SensorCalibrationRun, TakesRaFromTheProfilometersFile) {
    test::ScratchDir folder;
    const auto rough = folder.write("p120.csv", "Ra;42,4;µm\nRz;301;µm\n");
    const auto outcome = calibrateSensor("sim:", with(kShort, {{"rough_file", rough.string()}}));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_NEAR(outcome.results["surfaces"][1]["ra_um"].get<double>(), 42.4, 1e-9);
    EXPECT_EQ(outcome.results["surfaces"][1]["source"], rough.string());
    const auto bad = folder.write("bad.csv", "lc;0,8;mm\nRa;42,4\n");
    const auto refused = calibrateSensor("sim:", with(kShort, {{"rough_file", bad.string()}}));
    ASSERT_TRUE(refused.error);
    EXPECT_THAT(refused.error->message, HasSubstr("line 2: Ra is 42.4 without a unit"));
}

TEST(SensorCalibrationRun, RefusesTypingErrorsBeforeAnythingMoves) {
    const std::pair<Settings, const char*> wrong[] = {
        {{{"rough_ra_um", "1"}, {"rough_rz_um", "5"}}, "Ra of the rough reference is 1 um"},
        {{{"rough_rz_um", "5"}}, "Rz of P120 is 5 um"},
        {{{"more", "paper"}}, "more has \"paper\""},
        {{{"more", "paper 3 21; paper 4 21"}}, "surface paper is given twice"},
        {{{"more", "paper x3"}}, "is not a file that can be read"},
        {{{"weights_g", "20; 20"}}, "two or more different weights"},
        {{{"weights_g", "20; heavy"}}, "heavy; a number above 0"}};
    for (const auto& [changes, message] : wrong) {
        const auto outcome = calibrateSensor("sim:", with(kShort, changes));
        ASSERT_TRUE(outcome.error) << message;
        EXPECT_THAT(outcome.error->message, HasSubstr(message));
        EXPECT_TRUE(outcome.results.is_null() || !outcome.results.contains("rest")) << message;
    }
}

TEST(SensorCalibrationRun, WithoutAContactAreaTaxelsAreNotCalibratedAndItSaysSo) {
    const auto outcome = calibrateSensor(
        "sim:", with(kShort, {{"contact_area_cm2", "0"}, {"weights_g", "50; 200"}, {"weight_repeats", "1"}}));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    ASSERT_EQ(outcome.results["taxels"].size(), 8U);
    EXPECT_TRUE(outcome.results["taxels"][0]["scale"].is_null());
    EXPECT_THAT(outcome.results["taxels"][0]["reason"], HasSubstr("contact area is not known"));
    EXPECT_NEAR(outcome.results["force"]["scale"].get<double>(), 1, 0.02);
    EXPECT_TRUE(outcome.results["force"]["repeatability_pct_fs"].is_null()) << "nothing was repeated";
    EXPECT_TRUE(outcome.results["spearman"].is_null()) << "two surfaces";
}

TEST(SensorCalibrationRun, TheSameSeedGivesTheSameResultAndAnotherSeedAnother) {
    const auto surfaces = [](std::uint64_t seed) {
        return calibrateSensor("sim:", kShort, seed).results["surfaces"].dump();
    };
    const auto first = surfaces(4);
    EXPECT_GT(first.size(), 100U);
    EXPECT_EQ(first, surfaces(4));
    EXPECT_NE(first, surfaces(5));
}

TEST(SensorCalibrationRun, TheSessionHoldsEverySlideAndWeight) {
    RecordProperty("hazard", "H8");
    RunBench rig(true, "sim:", 1, true, kSensorBench);
    const auto outcome = runProtocol(rig.shipped("sensor-calibration",
                                                 with(kShort, {{"weights_g", "50; 200"}, {"weight_repeats", "2"}})))
                             .value();
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    rig.closeBench();
    ASSERT_TRUE(rig.writer().close());
    const auto reader = SessionReader::open(rig.folder().path() / "run.tacto").value();
    EXPECT_EQ(reader.trials().value().size(), 2U * 3 + 2 * 2 * 2);
    nlohmann::json results;
    const auto rows = reader.reportItems().value();
    for (const auto& row : rows)
        if (row.body.value("kind", "") == "results") results = row.body["results"];
    for (const char* shown : {"reference", "surfaces", "d_prime", "force", "taxels", "slides", "rest"})
        EXPECT_TRUE(results.contains(shown)) << shown;
}

TEST(SensorCalibrationRun, ListensOnTheSteadyClockToo) {
    RunBench rig(false, "sim:", 1, false, kSensorBench);
    const auto outcome =
        rig.run(test::withRun("verdict({ verdict: 'pass', rest: bench.measureRest({ duration_s: 0.5 }), at: "
                              "bench.measureWeight(200, { duration_s: 0.5 }) });"));
    ASSERT_IN_TIME(!outcome.error) << outcome.error->message;
    const auto& rest = outcome.results["rest"];
    EXPECT_EQ(rest["taxel_baseline"].size(), 8U);
    EXPECT_GT(rest["mean_square"].get<double>(), 0);
    EXPECT_NEAR(std::pow(rest["rms"].get<double>(), 2), rest["mean_square"].get<double>(), 1e-9);
    EXPECT_IN_TIME(rest["force"]["n"].get<int>() >= 50);  // 200 Hz; on a busy machine some samples come late
    EXPECT_NEAR(outcome.results["at"]["force"].get<double>(), 1.96, 0.1);
    EXPECT_TRUE(rig.outputOff());
}

/// The sensor fails at every step in turn: at rest, under the weights, while sliding.
class SensorCalibrationFault : public ::testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(SensorCalibrationFault, EndsWithOutputsOffAndKeepsWhatThereWas) {
    RecordProperty("hazard", "H2");
    const auto [fault, at_s] = GetParam();
    RunBench rig(true, fmt::format("sim:finger?fault={}@{}s", fault, at_s), 1, false, kSensorBench);
    const auto settings = with(kShort, {{"weights_g", "50; 200"}, {"weight_repeats", "1"}});
    const auto outcome = runProtocol(rig.shipped("sensor-calibration", settings)).value();
    ASSERT_TRUE(outcome.error);
    EXPECT_TRUE(rig.outputOff());
    EXPECT_NE(outcome.verdict, ScriptVerdict::Pass);
    ASSERT_TRUE(outcome.results.is_object()) << outcome.error->message;
    EXPECT_TRUE(outcome.results["partial"].get<bool>());
    EXPECT_TRUE(outcome.results["verdict"].is_null());
    EXPECT_EQ(outcome.results.contains("rest"), at_s > 4) << outcome.error->message;
    EXPECT_EQ(outcome.results.contains("weights"), at_s > 11) << outcome.error->message;
    EXPECT_EQ(outcome.results.contains("slides"), at_s > 25) << outcome.error->message;
    EXPECT_FALSE(outcome.results.contains("profile"));
}

INSTANTIATE_TEST_SUITE_P(AtEachStep, SensorCalibrationFault,
                         ::testing::Combine(::testing::Values("unplug", "stale"),
                                            ::testing::Values(2.0, 6.0, 14.0, 30.0)));

/// The operator stops at the n-th reading.
class SensorCalibrationCancel : public ::testing::TestWithParam<int> {};

TEST_P(SensorCalibrationCancel, EndsWithOutputsOffAndKeepsWhatThereWas) {
    RecordProperty("hazard", "H2");
    RunBench rig(true, "sim:", 1, false, kSensorBench);
    const auto outcome = rig.stoppedAt(GetParam(), "sensor-calibration",
                                       with(kShort, {{"weights_g", "50; 200"}, {"weight_repeats", "1"}}));
    ASSERT_TRUE(outcome.results.is_object());
    EXPECT_TRUE(outcome.results["partial"].get<bool>());
    // A reading is kept once record.partial() has it, including the reading at which the run was stopped.
    const auto kept = outcome.results.value("weights", nlohmann::json::array()).size() +
                      outcome.results.value("slides", nlohmann::json::array()).size();
    EXPECT_GE(kept, static_cast<std::size_t>(GetParam() - 1));
    EXPECT_LE(kept, static_cast<std::size_t>(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(AtEachStep, SensorCalibrationCancel, ::testing::Values(1, 3, 4, 5, 8));

}  // namespace
}  // namespace tacto
