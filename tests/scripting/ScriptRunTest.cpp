#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "core/session/SessionReader.h"
#include "tests/scripting/RunBench.h"

namespace tacto {
namespace {

using test::RunBench;
using test::withRun;

TEST(ScriptRun, GivesParametersAndTakesTheVerdict) {
    RunBench rig;
    auto request = rig.request(
        withRun("return verdict({ verdict: p.load > 500 ? 'pass' : 'fail', reasons: ['so'], x: p.load });"));
    request.parameters = {{"load", 1000}};
    const auto outcome = runProtocol(std::move(request)).value();
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Pass);
    EXPECT_EQ(outcome.reasons, std::vector<std::string>{"so"});
    EXPECT_EQ(outcome.results["x"], 1000);
    EXPECT_FALSE(outcome.error);
}

TEST(ScriptRun, HasNoVerdictWithoutOne) {
    RunBench rig;
    EXPECT_EQ(rig.run(withRun("return 'pass';")).verdict, ScriptVerdict::None);
    EXPECT_EQ(rig.run(withRun("verdict({ verdict: null });")).verdict, ScriptVerdict::None);
}

TEST(ScriptRun, TakesNoVerdictFromARunThatFailedAfterwards) {
    RunBench rig;
    const auto outcome = rig.run(withRun("verdict({ verdict: 'pass' });\n throw 'but';"));
    EXPECT_EQ(outcome.verdict, ScriptVerdict::None);
    ASSERT_TRUE(outcome.error);
    EXPECT_EQ(outcome.error->message, "/lab/probe.js:3: but");
    EXPECT_EQ(outcome.line, 3);
    EXPECT_TRUE(outcome.results.is_null());
}

TEST(ScriptRun, DisarmsByWhateverDoorRunIsLeft) {
    RecordProperty("hazard", "H10");
    for (const char* leave : {"return;", "throw 'out';", "bench.wait(-1);", "null.x;"}) {
        RunBench rig;
        bool armed = false;
        auto request =
            rig.request(withRun(std::string("bench.arm({ load: 1000 }); bench.drive('manual', { roughness: 1 });"
                                            "bench.wait(1); log(bench.live().state);") +
                                leave));
        request.onLog = [&](const std::string& text) { armed = text == "armed" || text == "delivering"; };
        const auto outcome = runProtocol(std::move(request)).value();
        EXPECT_TRUE(armed) << leave << (outcome.error ? outcome.error->message : "");
        EXPECT_TRUE(rig.outputOff()) << leave;
    }
}

/// The script watches a finger as live.js and massager.js do.
TEST(ScriptRun, WatchesTheBenchLessOftenTheLongerItTakes) {
    for (const auto& [seconds, step] : {std::pair(2.0, 0.05), std::pair(180.0, 0.1)}) {
        RunBench rig;
        const auto outcome =
            rig.run(withRun(fmt::format("const states = bench.watch({});"
                                        "const first = states[0].time_s, second = states[1].time_s;"
                                        "return verdict({{ verdict: null, states: states.length, step: second - first,"
                                        "  last: states[states.length - 1].time_s - first }});",
                                        seconds)));
        ASSERT_FALSE(outcome.error) << outcome.error->message;
        EXPECT_NEAR(outcome.results["step"].get<double>(), step, 0.006);
        EXPECT_NEAR(outcome.results["states"].get<double>(), seconds / step, 5 + 0.02 * seconds / step);
        EXPECT_LE(outcome.results["states"].get<int>(), 2000);
        EXPECT_NEAR(outcome.results["last"].get<double>(), seconds - step, 0.02 * seconds);
    }
}

TEST(ScriptRun, ReportsProgressAndLogs) {
    RunBench rig;
    std::vector<std::string> seen;
    auto request = rig.request(withRun("for (const x of progress([10, 20], 'Steps')) log('at', x, { a: 1 });"));
    request.onProgress = [&](const ScriptProgress& p) {
        seen.push_back(fmt::format("{} {}/{}", p.label, p.done, p.total));
    };
    const auto outcome = runProtocol(std::move(request)).value();
    EXPECT_EQ(seen, (std::vector<std::string>{"Steps 0/2", "Steps 1/2", "Steps 2/2"}));
    EXPECT_EQ(outcome.log, (std::vector<std::string>{"at 10 {\"a\":1}", "at 20 {\"a\":1}"}));
}

TEST(ScriptRun, SameSeedGivesTheSameTrials) {
    const std::string script = withRun(
        "log(random.blocks(['a', 'b', 'c', 'd'], 5).join('')); log(random.shuffle([1, 2, 3, 4, 5, 6]).join(''));"
        "log(random.uniform(2, 3)); log(Math.random());");
    const auto logOf = [&](std::uint64_t seed) { return RunBench(true, "sim:", seed).run(script).log; };
    const auto first = logOf(7);
    ASSERT_EQ(first.size(), 4U);
    EXPECT_EQ(first, logOf(7));
    EXPECT_NE(first, logOf(8));
    // Every block contains every element once.
    for (std::size_t block = 0; block < 5; ++block) {
        std::string part = first[0].substr(4 * block, 4);
        std::sort(part.begin(), part.end());
        EXPECT_EQ(part, "abcd");
    }
}

TEST(ScriptRun, ArgumentErrorsNameTheFunctionTheValueAndWhatIsAccepted) {
    RunBench rig;
    const auto error = [&](const char* code) {
        const auto outcome = rig.run(withRun(code));
        return outcome.error ? outcome.error->message : "";
    };
    EXPECT_EQ(error("bench.wait('x')"),
              "/lab/probe.js:2: bench.wait: seconds is \"x\", a number from 0 to 86400 is expected");
    EXPECT_EQ(error("bench.wait(NaN)"),
              "/lab/probe.js:2: bench.wait: seconds is NaN, a number from 0 to 86400 is expected");
    EXPECT_EQ(error("bench.arm({ laod: 5 })"),
              "/lab/probe.js:2: bench.arm: \"laod\" is not a known key; accepted are load");
    EXPECT_EQ(error("bench.arm({ load: -5 })"), "/lab/probe.js:2: bench.arm: load is -5, ohms above 0 is expected");
    EXPECT_EQ(error("bench.drive('manual', { roughness: 2 })"),
              "/lab/probe.js:2: bench.drive: roughness is 2, a number from 0 to 1 is expected");
    EXPECT_EQ(error("measure.train([{ capture: 99 }])"),
              "/lab/probe.js:2: capture 99 is held no longer; measure captures before 64 more are taken");
    EXPECT_EQ(error("operator.confirm('wiring', 'Check the wiring')"),
              "/lab/probe.js:2: this run has no operator to answer \"Check the wiring\"; give --set wiring=...");
    EXPECT_EQ(error("operator.confirm('wiring', 'Check', { drawing: '../help/window' })"),
              "/lab/probe.js:2: there is no drawing \"../help/window\"; there are: wiring");
    EXPECT_NE(error("verdict({ verdict: 'good' })"), "");
    EXPECT_NE(error("random.blocks('abc')"), "");
    EXPECT_NE(error("random.blocks([1], -1)"), "");
    EXPECT_NE(error("progress(5)"), "");
}

/// Measured values are listed with the settings, and whether the stimulator's accuracy explains the difference.
TEST(ScriptRun, ExposureSaysWhatWasMeasured) {
    RecordProperty("hazard", "H1");
    for (const double gain : {0.9, 0.97, 1.0, 1.03, 1.12}) {
        RunBench rig(true, fmt::format("sim:stimulator?gain={}", gain), 3, true);
        const auto outcome = rig.run(withRun(R"js(
            bench.arm({ load: 1000 });
            bench.drive("manual", { roughness: 0.5, pressure: 1 });
            bench.wait(2);
            return verdict({ verdict: null, rows: bench.exposure() });)js"));
        ASSERT_FALSE(outcome.error) << outcome.error->message;
        int measured = 0;
        for (const auto& row : outcome.results["rows"]) {
            if (row["measured"].is_null()) continue;
            ++measured;
            EXPECT_EQ(row["name"], "commanded voltage");
            EXPECT_NEAR(row["measured"].get<double>(), gain * 25, 0.5);
            EXPECT_EQ(row["measured_beyond"], std::abs(gain - 1) > 0.05) << gain;
        }
        EXPECT_EQ(measured, 1) << outcome.results["rows"].dump();
        rig.closeBench();
        ASSERT_TRUE(rig.writer().close());
        const auto reader = SessionReader::open(rig.folder().path() / "run.tacto").value();
        const auto kept = reader.measurements().value();
        const auto exposure = std::ranges::find(kept, std::string(kExposureMeasurement), &SessionRow::name);
        ASSERT_NE(exposure, kept.end());
        EXPECT_EQ(exposure->body["rows"], outcome.results["rows"]);
    }
}

TEST(ScriptRun, WritesTrialsFiguresAndTheVerdictIntoTheSession) {
    RunBench rig(true, "sim:", 3, true);
    const auto outcome = rig.run(withRun(R"js(
        bench.arm({ load: 1000 });
        bench.drive("manual", { roughness: 1, pressure: 1 });
        const seen = measure.train(bench.capture({ trains: 2 }));
        if (record.trial("rough-high", seen) !== 1) throw "number";
        report.figure("Waveforms", plot.waveforms());
        report.table("Trials", [{ amplitude_v: seen.amplitude_v }]);
        report.text("Done.");
        return verdict({ verdict: "pass", reasons: ["measured"], amplitude_v: seen.amplitude_v,
                         interval_s: seen.interval_s, width_s: seen.width_s });)js"));
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_NEAR(outcome.results["amplitude_v"].get<double>(), 40, 1);
    EXPECT_NEAR(outcome.results["interval_s"].get<double>(), 0.5, 0.005);
    EXPECT_NEAR(outcome.results["width_s"].get<double>(), 200e-6, 4e-6);
    rig.closeBench();
    ASSERT_TRUE(rig.writer().close());

    const auto reader = SessionReader::open(rig.folder().path() / "run.tacto").value();
    ASSERT_EQ(reader.trials().value().size(), 1U);
    EXPECT_EQ(reader.trials().value()[0].condition, "rough-high");
    ASSERT_EQ(reader.captures().value().size(), 2U);
    EXPECT_EQ(reader.captures().value()[0].trial, 1);
    const auto items = reader.reportItems().value();
    ASSERT_EQ(items.size(), 4U);
    EXPECT_EQ(items[0].body["kind"], "about");
    EXPECT_EQ(items[0].body["title"], "Probe");
    EXPECT_EQ(items[0].body["result_kind"], "") << "it declares none";
    EXPECT_EQ(items[1].body["figure"]["captures"][0]["capture"], reader.captures().value()[0].seq);
    const auto verdicts = reader.verdicts().value();
    ASSERT_EQ(verdicts.size(), 1U);
    EXPECT_EQ(verdicts[0].verdict, "pass");
}

TEST(ScriptRun, WritesEachTrialsCapturesAsFiles) {
    RunBench rig;
    auto request =
        rig.request(withRun("bench.arm(); bench.drive('manual', { roughness: 1, pressure: 1 });"
                            "record.trial('a', measure.train(bench.capture({ trains: 2 })));"));
    request.captureFolder = rig.folder().path();
    const auto outcome = runProtocol(std::move(request)).value();
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    for (const char* name : {"trial-0001-00001.csv", "trial-0001-00002.csv"}) {
        std::ifstream file(rig.folder().path() / name);
        std::string header;
        std::getline(file, header);
        EXPECT_EQ(header, "time_s,voltage_v,current_a") << name;
    }
}

}  // namespace
}  // namespace tacto
