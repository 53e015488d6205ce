// Scripts that try to keep a calibration that the program did not measure: nothing of it reaches the store.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/calibration/CalibrationStore.h"
#include "core/session/SessionReader.h"
#include "tests/scripting/DataHome.h"
#include "tests/scripting/RunBench.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

const std::set<Role> kCalibrated{Role::Stimulator, Role::Oscilloscope};

/// Enough levels and repeats for a complete calibration that passes.
constexpr const char* kInventedReadings = R"(
function invented(from, to) {
  const rows = [];
  for (let repeat = 1; repeat <= 5; ++repeat) {
    for (const direction of ["up", "down"]) {
      for (let k = 0; k < 11; ++k) {
        const commanded = from + (to - from) * k / 10;
        rows.push({ commanded, measured: commanded * 0.81 + 1e-7 * repeat * commanded, direction });
      }
    }
  }
  return rows;
}
const RANGES = { amplitude: [10, 40], interval: [0.5, 2], width: [1e-4, 4e-4], gap: [1e-4, 4e-4] };
)";

class ForgedCalibration : public DataHome {
protected:
    /// Returns the error that ended the run.
    [[nodiscard]] std::string run(const std::string& body, const std::string& device = "sim:") {
        RunBench rig(true, device, 1, true, kCalibrated);
        const auto outcome = runProtocol(rig.request(withRun(body) + kInventedReadings)).value();
        EXPECT_TRUE(rig.outputOff());
        return outcome.error ? outcome.error->message : "";
    }
    /// Runs the shipped protocol with `from` replaced by `to` in its text.
    [[nodiscard]] ScriptOutcome altered(const std::string& from, const std::string& to,
                                        std::map<std::string, std::string> settings,
                                        const std::string& device = "sim:", bool looksReal = false,
                                        const KnownLines& calibration = {}) {
        RunBench rig(true, device, 1, true, kCalibrated, looksReal, calibration);
        settings["store"] = "true";
        auto request = rig.shipped("stimulator-calibration", settings);
        auto& text = request.script.text;
        const auto at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        auto outcome = runProtocol(std::move(request)).value();
        rig.closeBench();
        EXPECT_TRUE(rig.writer().close());
        session_ = rig.writer().chainHead();
        return outcome;
    }
    [[nodiscard]] static std::vector<StoredCalibration> kept() {
        return CalibrationStore::open(calibrationFile()).value().all();
    }

    std::string session_;
};

TEST_F(ForgedCalibration, OneThatIsWrittenDownIsNotKept) {
    RecordProperty("hazard", "H1");
    EXPECT_THAT(run(R"(
  const levels = [{ commanded: 10, expanded_uncertainty: 0.01 }, { commanded: 40, expanded_uncertainty: 0.01 }];
  const one = quantity => ({ quantity, complete: true, verdict_iec: "pass", gain: 0.81, offset: 0, unit: "V", levels });
  const found = { amplitude: one("amplitude"), interval: one("interval"), width: one("width"), gap: one("gap") };
  record.calibration(found, { valid_days: 366 });)"),
                HasSubstr("amplitude was not computed from readings that this run took itself"));
    EXPECT_TRUE(kept().empty());
}

TEST_F(ForgedCalibration, OneOfInventedReadingsIsNotKept) {
    RecordProperty("hazard", "H1");
    EXPECT_THAT(run(R"(
  const found = {};
  for (const quantity in RANGES) {
    found[quantity] = analysis.calibration(invented(RANGES[quantity][0], RANGES[quantity][1]),
                                           { quantity, unit: quantity === "amplitude" ? "V" : "s",
                                             gain_tolerance: 0, resolution: 0 });
    if (!found[quantity].complete || found[quantity].verdict_iec !== "pass") throw new Error("the test is wrong");
  }
  record.calibration(found);)"),
                HasSubstr("amplitude was not computed from readings that this run took itself"));
    EXPECT_TRUE(kept().empty());
}

TEST_F(ForgedCalibration, NumbersOfReadingsThatDoNotExistAreRefused) {
    RecordProperty("hazard", "H1");
    EXPECT_THAT(
        run(R"(analysis.calibration(invented(10, 40).map((row, i) => Object.assign(row, { reading: i + 1 })));)"),
        HasSubstr("there is no reading 1 in this run"));
}

TEST_F(ForgedCalibration, AReadingCountsOnce) {
    RecordProperty("hazard", "H1");
    const std::string takeOne = R"(
  bench.arm({ load: 1000 });
  bench.drive("manual", { roughness: 1, pressure: 1 });
  const captures = bench.capture({ rate_hz: 2e6 });
  const a = measure.pulse(captures), b = measure.pulse(captures);
  const row = r => ({ reading: r.reading, commanded: 1, measured: 1, direction: "up" });)";
    EXPECT_THAT(run(takeOne + "analysis.calibration([row(a), row(a)]);"), HasSubstr("a reading counts once"));
    EXPECT_THAT(run(takeOne + "analysis.calibration([row(a), row(b)]);"), HasSubstr("shares a capture"));
}

TEST_F(ForgedCalibration, WhatAScriptSaysBesideAReadingDoesNotCount) {
    RecordProperty("hazard", "H1");
    const auto lied = altered("const results = bench.stimulatorCalibration.conclude();", R"(
  const forged = {};
  for (const quantity of Object.keys(TITLES)) {
    const trials = record.trials().filter((trial) => trial.condition.startsWith(quantity + " "));
    forged[quantity] = analysis.calibration(trials.map((trial) => ({ reading: trial.reading, commanded: 1 + trial.trial,
      measured: 0.83 * (1 + trial.trial), direction: trial.condition.split(" ")[1] })), { quantity });
  }
  record.calibration(forged);
  return;)",
                              {});
    ASSERT_FALSE(lied.error) << lied.error->message;
    const auto all = kept();
    ASSERT_EQ(all.size(), 1U);
    EXPECT_NEAR(all[0].amplitude.gain, 1, 0.012);
    EXPECT_NEAR(all[0].interval->gain, 1, 0.001);
    EXPECT_TRUE(all[0].simulated);
    EXPECT_EQ(all[0].readings, 440U);
    EXPECT_EQ(all[0].session, "run.tacto");
    EXPECT_EQ(all[0].sessionHead.size(), 64U);
    EXPECT_NE(all[0].sessionHead, session_) << "of the moment at which it was kept";
    ASSERT_EQ(all[0].instruments.size(), 1U);
    EXPECT_NEAR(all[0].instruments[0].gainTolerance.value_or(0), 0.005, 1e-9);
    EXPECT_EQ(all[0].instruments[0].statedBy, "the instrument");
}

TEST_F(ForgedCalibration, TheCommandIsThatOfTheCaptureWhateverCameAfter) {
    RecordProperty("hazard", "H1");
    // Measured after the command was lowered: the reading must still belong to the train that it shows.
    const auto outcome = [&] {
        RunBench rig(true, "sim:", 1, true, kCalibrated);
        return rig.run(withRun(R"(
  bench.arm({ load: 1000 });
  bench.drive("manual", { roughness: 1, pressure: 1 });
  const captures = bench.capture({ rate_hz: 2e6 });
  bench.drive("manual", { roughness: 0.5, pressure: 1 });
  bench.wait(2);
  bench.disarm();
  bench.setEncoding({ phase_width_us: 150 });
  return verdict({ verdict: null, reading: measure.pulse(captures) });)"));
    }();
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& commanded = outcome.results["reading"]["commanded"];
    EXPECT_NEAR(commanded["amplitude"].get<double>(), 40, 1e-9);
    EXPECT_NEAR(commanded["width_s"].get<double>(), 200e-6, 1e-12);
}

TEST_F(ForgedCalibration, AReadingOfUnlikeTrainsHasNoKnownCommand) {
    RecordProperty("hazard", "H1");
    // The encoder is still moving down. A mean over the record would look like a stimulator that delivers too little,
    // and a calibration from it would make every later train too strong.
    for (const char* limit : {"amplitude_slew_v_per_s: 20", "interval_ratio_per_train: 1.15"}) {
        RunBench rig(true, "sim:", 1, true, kCalibrated);
        const auto outcome = rig.run(withRun(std::string("bench.setEncoding({ ") + limit + R"( });
  bench.arm({ load: 1000 });
  bench.drive("manual", { roughness: 1, pressure: 1 });
  bench.wait(12);
  bench.drive("manual", { roughness: 0, pressure: 0 });
  const long = measure.pulse(bench.capture({ trains: 1, rate_hz: 1e5, samples: 150000 }));
  const two = measure.pulse(bench.capture({ trains: 2, rate_hz: 1e6 }));
  bench.wait(40);
  const after = measure.pulse(bench.capture({ trains: 2, rate_hz: 1e6 }));
  return verdict({ verdict: null, long, two, after });)"));
        ASSERT_FALSE(outcome.error) << outcome.error->message;
        EXPECT_TRUE(outcome.results["long"]["commanded"]["amplitude"].is_null()) << limit;
        const bool byInterval = std::string_view(limit).starts_with("interval");
        EXPECT_EQ(outcome.results["two"]["commanded"]["interval_s"].is_null(), byInterval) << limit;
        EXPECT_NEAR(outcome.results["after"]["commanded"]["amplitude"].get<double>(), 10, 1e-6) << limit;
        EXPECT_NEAR(outcome.results["after"]["commanded"]["interval_s"].get<double>(), 2, 1e-3) << limit;
    }
}

/// A check pulse precedes the first train: a mean of both would look like a stimulator that delivers too little.
TEST_F(ForgedCalibration, ARecordOfACheckPulseAndATrainIsJudgedByNoOtherCommandThanItShows) {
    RecordProperty("hazard", "H1");
    for (const char* accuracy : {"stated", "unknown"}) {
        for (const double strength : {0.0, 0.3, 1.0}) {
            RunBench rig(true, fmt::format("sim:oscilloscope?accuracy={}", accuracy), 1, true, kCalibrated);
            const auto outcome = rig.run(withRun(fmt::format(R"(
  bench.arm({{ load: 1000 }});
  bench.wait(6);
  bench.drive("manual", {{ roughness: {}, pressure: 1 }});
  const both = measure.pulse(bench.capture({{ trains: 1, rate_hz: 1e6, samples: 300000 }}));
  const one = measure.pulse(bench.capture({{ trains: 1, rate_hz: 1e6, samples: 300000 }}));
  return verdict({{ verdict: null, readings: [both, one] }});)",
                                                             strength)));
            ASSERT_FALSE(outcome.error) << outcome.error->message;
            for (const auto& reading : outcome.results["readings"]) {
                const auto& commanded = reading["commanded"]["amplitude"];
                if (commanded.is_null()) continue;
                EXPECT_NEAR(reading["amplitude"].get<double>(), commanded.get<double>(), 0.2 * commanded.get<double>());
            }
            const auto& one = outcome.results["readings"][1]["commanded"]["amplitude"];
            ASSERT_FALSE(one.is_null()) << outcome.results.dump();
            EXPECT_NEAR(one.get<double>(), 10 + 30 * strength, 0.05);
        }
    }
}

TEST_F(ForgedCalibration, AnAccuracyThatOnlyTheScriptStatesDoesNotCount) {
    RecordProperty("hazard", "H1");
    const std::string silent = "sim:oscilloscope?accuracy=unknown";
    const std::string from = "function run(p) {", vouching = "function run(p) { p.scope_gain_pct = 0.5;";
    const auto vouched = altered(from, vouching, {}, silent);
    EXPECT_EQ(vouched.verdict, ScriptVerdict::Indeterminate);
    ASSERT_FALSE(vouched.reasons.empty());
    EXPECT_THAT(vouched.reasons.front(), HasSubstr("was not evaluated"));
    EXPECT_TRUE(kept().empty());
    // A statement by the operator is accepted.
    const auto stated = altered(from, vouching, {{"scope_gain_pct", "1"}, {"timebase_ppm", "50"}}, silent);
    ASSERT_FALSE(stated.error) << stated.error->message;
    ASSERT_EQ(kept().size(), 1U);
    EXPECT_EQ(kept()[0].instruments[0].statedBy, "the operator");
    EXPECT_NEAR(kept()[0].instruments[0].gainTolerance.value_or(0), 0.01, 1e-9) << "as the operator said it";
}

TEST_F(ForgedCalibration, AStimulatorThatLooksRealIsNotCalibratedByASimulatedOscilloscope) {
    RecordProperty("hazard", "H1");
    const auto outcome = altered("protocol({", "protocol({", {}, "sim:", true);
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    ASSERT_EQ(kept().size(), 1U);
    EXPECT_TRUE(kept()[0].simulated);
    const auto store = CalibrationStore::open(calibrationFile()).value();
    EXPECT_EQ(store.proven(kept()[0].serial, "V", false), nullptr);
    EXPECT_FALSE(store.valid(kept()[0].serial, "V", kept()[0].made, false));
}

TEST_F(ForgedCalibration, ReadingsThatWereTakenWithACalibrationAppliedAreNotKept) {
    RecordProperty("hazard", "H1");
    const StimulatorCalibration applied{{0.9, 0, 10, 40},
                                        CalibrationLine{1, 0, 0.5, 2},
                                        CalibrationLine{1, 0, 100e-6, 400e-6},
                                        CalibrationLine{1, 0, 100e-6, 400e-6}};
    const auto outcome = altered("operator.wired(p.load);", "operator.wired(p.load); bench.useCalibration(true);", {},
                                 "sim:stimulator?gain=0.9", false, applied);
    ASSERT_TRUE(outcome.error);
    EXPECT_THAT(outcome.error->message, HasSubstr("were taken with the stored calibration applied"));
    EXPECT_TRUE(kept().empty());
}

}  // namespace
}  // namespace tacto::test
