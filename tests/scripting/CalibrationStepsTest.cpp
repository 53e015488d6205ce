// The beginning and the end of a calibration, and its levels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>

#include "app/scripting/host/sensor_calibration/FingertipCalibration.h"
#include "app/scripting/host/stimulator_calibration/StimulatorLevels.h"
#include "core/analysis/calibration/CalibrationJson.h"
#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"
#include "tests/scripting/RunBench.h"

namespace tacto {
namespace {

using Json = nlohmann::json;
using namespace host::stimulator_calibration;
using host::sensor_calibration::judgeWeight;
using test::RunBench;
using test::withRun;

TEST(KnownWeight, ReadsAsWhatItIsOrStandsOutFromRestWhereItsUnitIsNotKnown) {
    FingertipRest rest;
    rest.force.sd = 0.01;
    rest.inUse = ForceInUse{0, StreamUnit::Newton, 0.001};
    const host::sensor_calibration::WeighingTolerances known{0.001, 0.0027}, weightAlone{0.001};
    const auto read = [&](double mean, StreamUnit unit, const auto& tolerances) {
        return judgeWeight(WeightReading{.mass_g = 100, .reference_n = 0.98, .inUse = ForceInUse{mean, unit, 0.001}},
                           rest, tolerances, 10);
    };
    const auto right = read(1, StreamUnit::Newton, known);
    EXPECT_TRUE(right.passed());
    EXPECT_EQ(right.reason, "");
    EXPECT_NEAR(right.deviation_pct, 100 * (1 / 0.98 - 1), 1e-9);
    EXPECT_EQ(toJson(right)["unit"], "N");
    const auto is = [](const auto& weight, const char* verdict, const char* reason) {
        EXPECT_EQ(toJson(weight)["verdict"], verdict);
        EXPECT_EQ(toJson(weight)["passed"], std::string_view(verdict) == "pass");
        EXPECT_THAT(weight.reason, testing::HasSubstr(reason));
    };
    is(read(1.2, StreamUnit::Newton, known), "fail", "1.2000 ± 0.0045 N was read under 0.9800 N; 10 % are allowed");
    is(read(0.06, StreamUnit::Count, known), "pass", "");
    is(read(0.04, StreamUnit::Count, known), "fail", "failed");
    // 9.857 % of the allowed 10 %: an uncertainty of 0.4 % leaves the verdict open; without uncertainty nothing passes.
    is(read(1.0766, StreamUnit::Newton, known), "indeterminate", "is indeterminate: 1.0766 ±");
    is(read(1, StreamUnit::Newton, weightAlone), "not evaluated", "was not stated");
    is(read(kNaN, StreamUnit::Newton, known), "not evaluated", "nothing was read under");
    const auto none = toJson(judgeWeight({}, rest, known, 10));
    EXPECT_TRUE(none["passed"].is_null());
    EXPECT_EQ(none["verdict"], "not evaluated");
    EXPECT_FALSE(none.contains("unit"));
}

TEST(TimeBase, IsJudgedWithItsUncertainty) {
    const auto clock = [](double gain, const Json& u) {
        return timeBaseProblem({{"gain", gain}, {"gain_expanded_uncertainty", u}});
    };
    EXPECT_EQ(clock(1.004, 0.0005), "");
    EXPECT_THAT(clock(1.0045, 0.001), testing::HasSubstr("the time base is not sure"));
    EXPECT_NE(clock(1, nullptr), "");
    EXPECT_EQ(timeBaseProblem(nullptr), "");
}

/// Level `share` of each quantity, 0 to 1, on a simulated stimulator without faults.
constexpr const char* kLevels =
    "const settings = { mode: 'full', quantities: 'all', levels: 2, repeats: 2, store: false, valid_days: 1,"
    "scope_due: '', load: 1000, rate_hz: 2e6, settling_s: 0, warm_up_s: 0, amplitude_min_v: 10, amplitude_max_v: 40,"
    "interval_min_s: 0.5, interval_max_s: 2, width_min_us: 100, width_max_us: 400, gap_min_us: 100, gap_max_us: 300,"
    "tolerance_pct: 2, timing_tolerance_pct: 1, load_tolerance_pct: 1, reference_tolerance_pct: 5, reference_v: 0,"
    "reference_u_pct: 0 }, steps = bench.stimulatorCalibration;"
    "const level = (share, direction) => steps.read({ share: share, direction: direction, repeat: 1 });\n";

TEST(CalibrationLevels, AreSetAsAskedAndReadOffTheOscilloscope) {
    RecordProperty("hazard", "H1");
    RunBench rig;
    const auto outcome = rig.run(withRun(std::string(kLevels) + R"(
        steps.begin(settings);
        const known = steps.knownLoad(settings), off = bench.live().state;
        for (const [quantity, share] of [["amplitude", 0], ["interval", 1], ["width", 0.5], ["gap", 1]]) {
          steps.levels(quantity);
          level(share, "up");
          bench.disarm();
        }
        return verdict({ verdict: null, known: known, off: off, read: record.trials() });)"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& results = outcome.results;
    EXPECT_EQ(results["known"], true);
    EXPECT_EQ(results["off"], "disarmed");
    const std::map<std::string, double> wanted{{"amplitude", 10}, {"interval", 2}, {"width", 250e-6}, {"gap", 300e-6}};
    ASSERT_EQ(results["read"].size(), wanted.size());
    for (const auto& row : results["read"]) {
        const auto condition = row["condition"].get<std::string>();
        const auto quantity = condition.substr(0, condition.find(' '));
        const auto key = quantity == "amplitude" ? quantity : quantity + "_s";
        const double value = wanted.at(quantity);
        EXPECT_NEAR(row["commanded"][key].get<double>(), value, 1e-6 * value) << quantity;
        EXPECT_NEAR(row[key].get<double>(), value, 0.02 * value) << quantity;
        EXPECT_EQ(condition, quantity + " up");
    }
}

TEST(CalibrationLevels, LeaveTheOutputOffWhereOneCannotBeRead) {
    RecordProperty("hazard", "H1");
    RunBench rig(true, "sim:stimulator?load=1500ohm");
    const auto stateAfter = [&](const std::string& call) {
        const auto outcome =
            rig.run(withRun(std::string(kLevels) + "let state = ''; try { steps.begin(settings); " + call +
                            " } catch (error) { state = bench.live().state; }"
                            "return verdict({ verdict: null, state: state });"));
        EXPECT_FALSE(outcome.error) << outcome.error->message;
        return outcome.results.value("state", "");
    };
    EXPECT_EQ(stateAfter("steps.knownLoad(settings);"), "disarmed") << "another load is connected";
    EXPECT_EQ(stateAfter("bench.arm({ load: 1500 }); steps.read({});"), "disarmed");
    EXPECT_EQ(stateAfter("bench.arm({ load: 1500 }); level(0.5, 'up');"), "disarmed") << "of no quantity";
    EXPECT_EQ(stateAfter("bench.arm({ load: 1500 }); steps.levels('amplitude');"), "disarmed") << "no known load";
}

TEST(CalibrationLevels, OfARangeWithoutALengthAreRefused) {
    RunBench rig;
    const auto outcome =
        rig.run(withRun(std::string(kLevels) + "steps.begin(Object.assign({}, settings, { gap_max_us: 100 }));"));
    ASSERT_TRUE(outcome.error);
    EXPECT_THAT(outcome.error->message,
                testing::HasSubstr("begin: gap_min_us is 100, a number below gap_max_us, 100,"));
}

TEST(CalibrationVerdict, IsTheWorstQuantitysAndBeginsWithWhatIsNearestToItsTolerance) {
    const auto found = [](const char* quantity, const char* verdict, const char* reason, double error = 0) {
        const Json level = {{"worst_error", -error}, {"worst_expanded_uncertainty", 0.1}, {"tolerance", 1}};
        return Json{{"quantity", quantity},
                    {"verdict", verdict},
                    {"reasons", Json::array({reason})},
                    {"levels", Json::array({level})}};
    };
    const auto good = found("amplitude", "pass", "good"), open = found("gap", "indeterminate", "open", 0.3);
    const auto is = [](const Json& judged, const char* verdict, const std::vector<std::string>& reasons) {
        EXPECT_EQ(judged["verdict"], verdict);
        EXPECT_EQ(judged["reasons"], Json(reasons));
    };
    is(verdictOf({good}, "", true), "pass", {"Amplitude: good"});
    is(verdictOf({good, open, found("width", "fail", "bad", 0.5)}, "clock", true), "fail",
       {"clock; nothing was stored", "Phase width: bad", "Inter-phase gap: open", "Amplitude: good"});
    is(verdictOf({good}, "clock", false), "indeterminate", {"clock", "Amplitude: good"});
    is(checkVerdictOf({good, good}, "known"), "pass", {"known; it still holds at three levels of each"});
    is(checkVerdictOf({good, open}, "known"), "indeterminate", {"good", "open"});
}

TEST(GivenReadings, ThatAreNoneAreRefused) {
    RunBench rig;
    for (const auto& [row, refusal] :
         {std::pair("{ commanded: 2, measured: 4, direction: 'sideways' }",
                    "analysis.calibration: direction is \"sideways\", \"up\", \"down\" or \"\" is expected"),
          std::pair("{ commanded: '2', measured: 4 }",
                    "an object with commanded, measured and direction is expected")}) {
        const auto outcome = rig.run(
            withRun(fmt::format("analysis.calibration([{{ commanded: 1, measured: 2, direction: 'up' }}, {}]);", row)));
        ASSERT_TRUE(outcome.error);
        EXPECT_THAT(outcome.error->message, testing::HasSubstr(refusal));
    }
}

/// Checks a level of 20 V against a line through the origin, within 2 %.
Json checked(const Json& level) {
    Json all = {{"commanded", 20}, {"mean", 20.01}, {"expanded_uncertainty", 0.05}};
    all.update(level);
    return toJson(checkAgainst({{"gain", 1}, {"offset", 0}, {"lowest", 10}, {"highest", 40}},
                               {{"quantity", "amplitude"}, {"unit", "V"}, {"levels", Json::array({all})}}, 2));
}

TEST(CalibrationCheck, TheWorseDirectionIsJudged) {
    RecordProperty("hazard", "H9");
    const auto check = [](double up, double down, const Json& u) {
        return checked({{"mean", 20},
                        {"mean_up", up},
                        {"mean_down", down},
                        {"not_measured", 0},
                        {"worst_expanded_uncertainty", u}});
    };
    EXPECT_EQ(check(20.2, 19.8, 0.07)["verdict"], "pass");
    EXPECT_EQ(check(20.6, 19.4, 0.07)["verdict"], "fail") << "0.4 V are allowed, and their mean is exact";
    EXPECT_EQ(check(19.7, 20.3, 0.2)["verdict"], "indeterminate");
    EXPECT_EQ(check(20.2, 19.8, nullptr)["verdict"], "indeterminate") << "its U is not known";
    const auto found = check(19.3, 20.6, 0.07);
    EXPECT_EQ(found["rows"][0]["measured"], 19.3);
    EXPECT_EQ(found["rows"][0]["direction"], "up");
    EXPECT_THAT(found["reasons"][0].get<std::string>(), testing::HasSubstr("19.300 ± 0.070 V was measured going up"));
}

TEST(CalibrationCheck, AReadingThatWasNotMeasuredMayBeTheOneThatIsOff) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(checked({{"not_measured", 0}})["verdict"], "pass");
    EXPECT_EQ(checked({{"not_measured", 2}})["verdict"], "indeterminate");
    EXPECT_EQ(checked(Json::object())["verdict"], "indeterminate");
    EXPECT_THAT(checked({{"not_measured", 2}})["reasons"][0].get<std::string>(),
                testing::HasSubstr("2 of its readings were not measured"));
    EXPECT_EQ(checked({{"not_measured", 2}, {"mean", 25}})["verdict"], "fail");
}

}  // namespace
}  // namespace tacto
