// The host object "calibration": what a calibration begins and ends with, and its levels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>

#include "tests/scripting/RunBench.h"

namespace tacto {
namespace {

using test::RunBench;
using test::withRun;

TEST(KnownWeight, ReadsAsWhatItIsOrStandsOutFromRestWhereItsUnitIsNotKnown) {
    RunBench rig;
    const auto outcome = rig.run(withRun(R"(
        const rest = { force_in_use: { mean: 0, unit: 'N', u: 0.001 }, force: { sd: 0.01 } };
        const known = { weight_tolerance_pct: 0.1, gravity_tolerance_pct: 0.27 };
        const read = (mean, unit, stated) => calibration.knownWeight(
            { mass_g: 100, reference_n: 0.98, force_in_use: { mean: mean, unit: unit, u: 0.001 } }, rest, 10,
            stated || known);
        return verdict({ verdict: null, right: read(1, 'N'), wrong: read(1.2, 'N'), counts: read(0.06, 'count'),
            lost: read(0.04, 'count'), near: read(1.0766, 'N'), unstated: read(1, 'N', { weight_tolerance_pct: 0.1 }),
            nothing: read(null, 'N'), none: calibration.knownWeight(null, rest, 10) });)"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& results = outcome.results;
    EXPECT_EQ(results["right"]["check"]["passed"], true);
    EXPECT_EQ(results["right"]["reason"], "");
    EXPECT_NEAR(results["right"]["check"]["deviation_pct"].get<double>(), 100 * (1 / 0.98 - 1), 1e-9);
    EXPECT_EQ(results["wrong"]["check"]["passed"], false);
    EXPECT_EQ(results["wrong"]["reason"],
              "the known-reference check failed: 1.2000 ± 0.0045 N was read under 0.9800 N; 10 % are allowed, "
              "uncertainty included; nothing was calibrated");
    EXPECT_EQ(results["counts"]["check"]["passed"], true);
    EXPECT_TRUE(results["counts"]["check"]["deviation_pct"].is_null());
    EXPECT_EQ(results["lost"]["check"]["passed"], false);
    EXPECT_THAT(results["nothing"]["reason"].get<std::string>(), testing::HasSubstr("nothing was read under"));
    EXPECT_TRUE(results["none"]["check"]["passed"].is_null());
    const auto verdictOf = [&](const char* which) { return results[which]["check"]["verdict"]; };
    EXPECT_EQ(verdictOf("right"), "pass");
    EXPECT_EQ(verdictOf("wrong"), "fail");
    EXPECT_EQ(verdictOf("lost"), "fail");
    // 9.857 % of 10 %: U of 0.4 % leaves it open, and without U nothing passes.
    EXPECT_EQ(verdictOf("near"), "indeterminate");
    EXPECT_EQ(results["near"]["check"]["passed"], false);
    EXPECT_THAT(results["near"]["reason"].get<std::string>(), testing::HasSubstr("is indeterminate: 1.0766 ±"));
    EXPECT_EQ(verdictOf("unstated"), "not evaluated");
    EXPECT_THAT(results["unstated"]["reason"].get<std::string>(), testing::HasSubstr("was not stated"));
    EXPECT_EQ(verdictOf("nothing"), "not evaluated") << "what was not read did not fail";
    EXPECT_EQ(verdictOf("none"), "not evaluated");
}

TEST(KnownCalibrationRanges, AreNarrowedToWhatIsStoredAndTheTimeBaseIsJudgedWithItsUncertainty) {
    RunBench rig;
    const auto outcome = rig.run(withRun(R"(
        const line = (unit, lowest, highest) => ({ unit: unit, lowest: lowest, highest: highest });
        const stored = (unit) => ({ amplitude: line(unit, 12, 30), interval: line('s', 0.6, 3),
            width: line('s', 1e-4, 3e-4), gap: line('s', 1e-4, 4e-4) });
        const ranges = { amplitude_min_v: 10, amplitude_max_v: 40, interval_min_s: 0.5, interval_max_s: 2,
            width_min_us: 100, width_max_us: 400, gap_min_us: 100, gap_max_us: 400 };
        const clock = (gain, u) => calibration.timeBase({ gain: gain, gain_expanded_uncertainty: u });
        return verdict({ verdict: null, volts: calibration.knownRanges(stored('V'), ranges),
            current: calibration.knownRanges(stored('mA'), ranges), right: clock(1.004, 0.0005),
            wrong: clock(1.0045, 0.001), unknown: clock(1, null), none: calibration.timeBase(null) });)"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& results = outcome.results;
    EXPECT_EQ(results["volts"]["amplitude_min_v"], 12);
    EXPECT_EQ(results["volts"]["amplitude_max_v"], 30);
    EXPECT_EQ(results["volts"]["interval_min_s"], 0.6);
    EXPECT_EQ(results["volts"]["interval_max_s"], 2);
    EXPECT_NEAR(results["volts"]["width_max_us"].get<double>(), 300, 1e-9);
    EXPECT_EQ(results["current"]["amplitude_max_v"], 40) << "known in mA";
    EXPECT_EQ(results["right"], "");
    EXPECT_THAT(results["wrong"].get<std::string>(), testing::HasSubstr("the time base is not sure"));
    EXPECT_NE(results["unknown"], "");
    EXPECT_EQ(results["none"], "");
}

/// Level `share` of each quantity, 0 to 1, on a healthy twin.
constexpr const char* kLevels =
    "const settings = { load: 1000, rate_hz: 2e6, settling_s: 0, amplitude_min_v: 10, amplitude_max_v: 40,"
    "interval_min_s: 0.5, interval_max_s: 2, width_min_us: 100, width_max_us: 400, gap_min_us: 100, gap_max_us: 300,"
    "tolerance_pct: 2, timing_tolerance_pct: 1, load_tolerance_pct: 1 };"
    "const level = (quantity, share, direction) => calibration.readLevel(quantity,"
    "{ share: share, direction: direction, repeat: 1 }, settings);";

TEST(CalibrationLevels, AreSetAsAskedAndReadOffTheOscilloscope) {
    RecordProperty("hazard", "H1");
    RunBench rig;
    const auto outcome = rig.run(withRun(std::string(kLevels) + R"(
        const known = calibration.readKnownLoad(settings);
        const off = bench.live().state;
        const read = {};
        for (const [quantity, share] of [["amplitude", 0], ["interval", 1], ["width", 0.5], ["gap", 1]]) {
          calibration.beginLevels(quantity, settings);
          read[quantity] = level(quantity, share, "up").row;
          bench.disarm();
        }
        return verdict({ verdict: null, known: known, off: off, read: read });)"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& results = outcome.results;
    EXPECT_NEAR(results["known"]["load_ohm"].get<double>(), 1000, 20);
    EXPECT_NEAR(results["known"]["commanded"]["amplitude"].get<double>(), 40, 1e-9) << "of the largest amplitude";
    EXPECT_EQ(results["off"], "disarmed");
    const std::map<std::string, double> wanted{{"amplitude", 10}, {"interval", 2}, {"width", 250e-6}, {"gap", 300e-6}};
    for (const auto& [quantity, value] : wanted) {
        const auto& row = results["read"][quantity];
        EXPECT_NEAR(row["commanded"].get<double>(), value, 1e-6 * value) << quantity;
        EXPECT_NEAR(row["measured"].get<double>(), value, 0.02 * value) << quantity;
        EXPECT_EQ(row["direction"], "up");
    }
}

TEST(CalibrationLevels, LeaveTheOutputOffWhereOneCannotBeRead) {
    RecordProperty("hazard", "H1");
    RunBench rig(true, "sim:stimulator?load=1500ohm");
    const auto stateAfter = [&](const std::string& call) {
        const auto outcome = rig.run(withRun(std::string(kLevels) + "let state = ''; try { " + call +
                                             " } catch (error) { state = bench.live().state; }"
                                             "return verdict({ verdict: null, state: state });"));
        EXPECT_FALSE(outcome.error) << outcome.error->message;
        return outcome.results.value("state", "");
    };
    EXPECT_EQ(stateAfter("calibration.readKnownLoad(settings);"), "disarmed") << "another load is connected";
    EXPECT_EQ(stateAfter("bench.arm({ load: 1500 }); calibration.readLevel('power', {}, settings);"), "disarmed");
    EXPECT_EQ(stateAfter("bench.arm({ load: 1500 }); level('amplitude', 2, 'up');"), "disarmed");
}

TEST(CalibrationLevels, OfARangeWithoutALengthAreRefused) {
    RunBench rig;
    const auto outcome = rig.run(withRun(std::string(kLevels) +
                                         "calibration.checkRanges(settings);"
                                         "calibration.checkRanges(Object.assign({}, settings, { gap_max_us: 100 }));"));
    ASSERT_TRUE(outcome.error);
    EXPECT_EQ(
        outcome.error->message,
        "/lab/probe.js:2: calibration.checkRanges: gap_min_us is 100, a number below gap_max_us, 100, is expected");
}

TEST(CalibrationVerdict, IsTheWorstQuantitysAndNamesEachReason) {
    RunBench rig;
    const auto outcome = rig.run(withRun(R"(
        const found = (quantity, verdict, reason) => ({ quantity: quantity, verdict: verdict, reasons: [reason] });
        const good = found("amplitude", "pass", "good"), open = found("gap", "indeterminate", "open");
        const bad = found("width", "fail", "bad"), stored = { text: "known" };
        return verdict({ verdict: null, passed: calibration.stimulatorVerdict([good], "", true),
          failed: calibration.stimulatorVerdict([good, bad, open], "clock", true),
          clock: calibration.stimulatorVerdict([good], "clock", true),
          looked: calibration.stimulatorVerdict([good], "clock", false),
          holds: calibration.checkVerdict([good, good], stored),
          lost: calibration.checkVerdict([good, open], stored) });)"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto is = [&](const char* which, const char* verdict, const nlohmann::json& reasons) {
        EXPECT_EQ(outcome.results[which]["verdict"], verdict) << which;
        EXPECT_EQ(outcome.results[which]["reasons"], reasons) << which;
    };
    is("passed", "pass", nlohmann::json::array({"Amplitude: good"}));
    is("failed", "fail", {"clock; nothing was stored", "Amplitude: good", "Phase width: bad", "Inter-phase gap: open"});
    is("clock", "indeterminate", {"clock; nothing was stored", "Amplitude: good"});
    is("looked", "indeterminate", {"clock", "Amplitude: good"});
    is("holds", "pass", nlohmann::json::array({"known; it still holds at three levels of each"}));
    is("lost", "indeterminate", {"good", "open"});
}

TEST(CalibrationVerdict, BeginsWithWhatIsNearestToItsTolerance) {
    RunBench rig;
    const auto outcome = rig.run(withRun(R"(
        const found = (quantity, error) => ({ quantity: quantity, verdict: "pass", reasons: ["" + error],
          levels: [{ worst_error: 0, worst_expanded_uncertainty: 0.1, tolerance: 1 },
                   { worst_error: -error, worst_expanded_uncertainty: 0.1, tolerance: 1 }] });
        return verdict({ verdict: null, all: calibration.stimulatorVerdict(
          [found("amplitude", 0.2), found("interval", 0), found("width", 0.3), found("gap", 0.3)], "", true) });)"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.results["all"]["reasons"],
              nlohmann::json({"Phase width: 0.3", "Inter-phase gap: 0.3", "Amplitude: 0.2", "Interval: 0"}));
}

TEST(Weighings, GoUpAndDownAgainAndAgain) {
    RunBench rig;
    const auto outcome =
        rig.run(withRun("return verdict({ verdict: null, steps: calibration.weighings([20, 50], 2) });"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    std::string order;
    for (const auto& step : outcome.results["steps"])
        order += fmt::format("{}{}{} ", step["direction"] == "up" ? "+" : "-", step["mass_g"].get<double>(),
                             step["repeat"] == 1 ? "" : "'");
    EXPECT_EQ(order, "+20 +50 -50 -20 +20' +50' -50' -20' ");
}

TEST(GivenReadings, AreRefusedAlikeByEachFunctionThatTakesThem) {
    RunBench rig;
    for (const std::string function : {"analysis.calibration", "analysis.sensorScale"}) {
        const auto refusal = [&](const std::string& row) {
            const auto outcome =
                rig.run(withRun(function + "([{ commanded: 1, measured: 2, direction: 'up' }, " + row + "]);"));
            return outcome.error ? outcome.error->message : "";
        };
        EXPECT_THAT(refusal("{ commanded: 2, measured: 4, direction: 'sideways' }"),
                    testing::HasSubstr(function + ": direction is \"sideways\", \"up\", \"down\" or \"\" is expected"));
        EXPECT_THAT(refusal("{ commanded: '2', measured: 4 }"),
                    testing::HasSubstr("an object with commanded, measured and direction is expected"));
    }
    const auto weighed = rig.run(withRun(
        "analysis.fingertipScales([{ reading: { reference_n: 1, force: 1, taxels: [] }, direction: 'left' }], {});"));
    ASSERT_TRUE(weighed.error);
    EXPECT_THAT(weighed.error->message, testing::HasSubstr("analysis.fingertipScales: direction is \"left\""));
    const auto outcome = rig.run(withRun(R"(
        const rows = [1, 2, 3].map((commanded) => ({ commanded, measured: 2 * commanded + 1, direction: "up" }));
        return verdict({ verdict: null, scale: analysis.sensorScale(rows) });)"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_NEAR(outcome.results["scale"]["scale"].get<double>(), 0.5, 1e-12);
    EXPECT_NEAR(outcome.results["scale"]["offset"].get<double>(), -0.5, 1e-12);
}

TEST(CalibrationCheck, TheWorseDirectionIsJudged) {
    RecordProperty("hazard", "H9");
    RunBench rig;
    const auto check = [&](double up, double down, const std::string& u) {
        const auto outcome = rig.run(withRun(fmt::format(
            R"(
            const found = {{ quantity: "amplitude", unit: "V", levels: [{{ commanded: 20, mean: 20, mean_up: {},
                mean_down: {}, not_measured: 0, expanded_uncertainty: 0.05{} }}] }};
            const line = {{ gain: 1, offset: 0, lowest: 10, highest: 40 }};
            return verdict({{ verdict: null, check: analysis.calibrationCheck(found, line, 2) }});)",
            up, down, u)));
        EXPECT_FALSE(outcome.error) << outcome.error->message;
        return outcome.results["check"];
    };
    const std::string known = ", worst_expanded_uncertainty: 0.07";
    EXPECT_EQ(check(20.2, 19.8, known)["verdict"], "pass");
    EXPECT_EQ(check(20.6, 19.4, known)["verdict"], "fail") << "0.4 V are allowed, and their mean is exact";
    EXPECT_EQ(check(19.7, 20.3, ", worst_expanded_uncertainty: 0.2")["verdict"], "indeterminate");
    EXPECT_EQ(check(20.2, 19.8, "")["verdict"], "indeterminate") << "its U is not known";
    const auto found = check(19.3, 20.6, known);
    EXPECT_EQ(found["rows"][0]["measured"], 19.3);
    EXPECT_EQ(found["rows"][0]["direction"], "up");
    EXPECT_THAT(found["reasons"][0].get<std::string>(), testing::HasSubstr("19.300 ± 0.070 V was measured going up"));
}

TEST(CalibrationCheck, AReadingThatWasNotMeasuredMayBeTheOneThatIsOff) {
    RecordProperty("hazard", "H9");
    RunBench rig;
    const auto check = [&](const std::string& level) {
        const auto outcome = rig.run(withRun(R"(
            const found = { quantity: "amplitude", unit: "V", levels: [Object.assign(
                { commanded: 20, mean: 20.01, expanded_uncertainty: 0.05 }, )" +
                                             level + R"()] };
            const line = { gain: 1, offset: 0, lowest: 10, highest: 40 };
            return verdict({ verdict: null, check: analysis.calibrationCheck(found, line, 2) });)"));
        EXPECT_FALSE(outcome.error) << outcome.error->message;
        return outcome.results["check"];
    };
    EXPECT_EQ(check("{ not_measured: 0 }")["verdict"], "pass");
    for (const char* level : {"{ not_measured: 2 }", "{}"})
        EXPECT_EQ(check(level)["verdict"], "indeterminate") << level;
    EXPECT_THAT(check("{ not_measured: 2 }")["reasons"][0].get<std::string>(),
                testing::HasSubstr("2 of its readings were not measured"));
    EXPECT_EQ(check("{ not_measured: 2, mean: 25 }")["verdict"], "fail");
}

}  // namespace
}  // namespace tacto
