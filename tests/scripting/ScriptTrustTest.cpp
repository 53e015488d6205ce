// Requests of a script that are refused: a larger electrode, safety fields in a stored profile, files that it chooses
// itself.
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/session/SessionReader.h"
#include "tests/scripting/DataHome.h"
#include "tests/scripting/RunBench.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class ScriptTrust : public DataHome {
protected:
    /// Returns the error that ended the run. `area`: that of the profile; `given`: the operator's --set.
    [[nodiscard]] std::string run(const std::string& body, std::optional<double> area,
                                  const std::map<std::string, std::string>& given = {}) {
        rig_ = std::make_unique<RunBench>(true, "sim:", 1, true);
        auto profile = rig_->bench().profile();
        if (area) profile.electrodeArea = SquareCentimetres(*area);
        EXPECT_TRUE(rig_->bench().setProfile(profile));
        auto source = probe(
            "protocol({ title: \"Probe\", parameters: { "
            "area: { label: \"Smallest electrode\", unit: \"cm2\", min: 0, max: 1000, value: 50 }, "
            "file: { label: \"File\", type: \"text\", value: \"/etc/hostname\" } } }); function run(p) {\n" +
            body + "\n}\n");
        auto applied = applySettings(readDeclaration(source).value(), given).value();
        auto request = rig_->request(std::move(source));
        request.parameters = applied.parameters;
        request.operatorGave = applied.given;
        const auto outcome = runProtocol(std::move(request)).value();
        results_ = outcome.results;
        return outcome.error ? outcome.error->message : "";
    }
    [[nodiscard]] double areaInForce() const {
        const auto& area = rig_->bench().profile().electrodeArea;
        return area ? area->value() : 0;
    }
    /// Returns all text of the session.
    [[nodiscard]] std::string session() {
        rig_->closeBench();
        EXPECT_TRUE(rig_->writer().close());
        const auto reader = SessionReader::open(rig_->folder().path() / "run.tacto").value();
        std::string all;
        const auto events = reader.events().value(), items = reader.reportItems().value();
        for (const auto& row : events) all += row.name + " " + row.body.dump() + "\n";
        for (const auto& row : items) all += row.body.dump() + "\n";
        return all;
    }

    std::unique_ptr<RunBench> rig_;
    Json results_;
};

TEST_F(ScriptTrust, TheElectrodeShrinksAndNeverGrows) {
    RecordProperty("hazard", "H1");
    EXPECT_EQ(run("bench.setElectrodeArea(2);", 3), "");
    EXPECT_EQ(areaInForce(), 2);
    EXPECT_THAT(session(), HasSubstr("Electrode area: 2 cm² for this run; the profile states 3 cm²."));
    EXPECT_THAT(run("bench.setElectrodeArea(1000);", 3), HasSubstr("1000 cm² is larger than the 3 cm² of the profile"));
    EXPECT_EQ(areaInForce(), 3);
    EXPECT_THAT(run("bench.setElectrodeArea(1); bench.setElectrodeArea(3); bench.setElectrodeArea(3.01);", 3),
                HasSubstr("3.01 cm² is larger"));
    // The operator's --set does not help either: the area must be changed in the profile.
    EXPECT_THAT(run("bench.setElectrodeArea(p.area);", 3, {{"area", "4"}}), HasSubstr("4 cm² is larger"));
}

TEST_F(ScriptTrust, ReferencesAreFeltInTheRunAndNotMadeUp) {
    RecordProperty("hazard", "H7");
    const std::string felt = "const s = bench.measureReference('plastic'), r = bench.measureReference('P120');\n";
    EXPECT_EQ(run(felt + "bench.setReferences(s, r);", {}), "");
    EXPECT_TRUE(rig_->bench().profile().roughness.calibrated);
    // A number, a name, an invented field, an unmeasured reference, or no measurement at all: none is accepted.
    for (const char* forged :
         {"bench.setReferences({ h: 0.001, v: 0.001 }, { h: 0.002, v: 0.002 });",
          "s.h *= 0.99; bench.setReferences(s, r);", "r.material = 'glass'; bench.setReferences(s, r);",
          "bench.setReferences(Object.assign({}, s, { more: 1 }), r);",
          "bench.setReferences(s, { h: s.h, v: s.v });"}) {
        EXPECT_THAT(run(felt + forged, {}),
                    HasSubstr("what bench.measureReference() returned in this run, unchanged, is "
                              "expected"))
            << forged;
        EXPECT_FALSE(rig_->bench().profile().roughness.calibrated) << forged;
    }
}

TEST_F(ScriptTrust, WithoutAnAreaInTheProfileTheOperatorsWordIsNeeded) {
    RecordProperty("hazard", "H1");
    EXPECT_THAT(run("bench.setElectrodeArea(1000);", {}), HasSubstr("the operator did not give 1000 cm²"));
    EXPECT_THAT(run("bench.setElectrodeArea(p.area);", {}), HasSubstr("the operator did not give 50 cm²"))
        << "a default is the script's word";
    EXPECT_THAT(run("bench.setElectrodeArea(100);", {}, {{"area", "4"}}), HasSubstr("did not give 100 cm²"));
    EXPECT_EQ(areaInForce(), 0);
    EXPECT_EQ(run("bench.setElectrodeArea(p.area);", {}, {{"area", "4"}}), "");
    EXPECT_EQ(areaInForce(), 4);
    const auto said = session();
    EXPECT_THAT(said, HasSubstr("electrode area {\"area_cm2\":4.0,\"declared_by\":\"the operator\""));
    EXPECT_THAT(said, HasSubstr("Electrode area: 4 cm², declared by the operator."));
}

// The shortest calibration of the simulated fingertip.
constexpr const char* kCalibrates = R"js(
const steps = bench.sensorCalibration;
const surfaces = steps.begin({ smooth: "glass", smooth_ra_um: 0.02, smooth_rz_um: 0, smooth_file: "", rough: "P120",
  rough_ra_um: 42, rough_rz_um: 0, rough_file: "", more: "", weights_g: "100; 200", weight_repeats: 1,
  weight_tolerance_pct: 0.1, gravity_m_s2: 9.8, gravity_tolerance_pct: 0.1, contact_area_cm2: 1,
  contact_area_tolerance_pct: 1, reference_tolerance_pct: 20, speed_mm_s: 50, force_n: 1, duration_s: 2, store: true });
steps.knownWeight();
for (const step of steps.weighings) steps.weigh(step);
steps.scale();
const slideAll = () => { for (const surface of surfaces) for (let i = 0; i < 3; ++i) steps.slide(surface); };
)js";

TEST_F(ScriptTrust, AStoredProfileTakesOverTheScalesAndNothingElse) {
    RecordProperty("hazard", "H1");
    const auto error = run(
        std::string("bench.setElectrodeArea(1); bench.setEncoding({ amplitude_max_v: 20, pulses: 3 });") + kCalibrates +
            "slideAll(); const found = steps.conclude();\n"
            "return verdict({ verdict: null, smooth: found.roughness.references.h.smooth, kept: found.profile });",
        3);
    ASSERT_EQ(error, "");
    const auto kept = loadProfile(results_["kept"]["file"].get<std::string>()).value();
    EXPECT_NEAR(kept.roughness.h.smooth, results_["smooth"].get<double>(), 1e-12);
    EXPECT_TRUE(kept.roughness.calibrated);
    EXPECT_EQ(kept.electrodeArea, SquareCentimetres(3));
    EXPECT_EQ(kept.encoding, EncodingProfile{});
    EXPECT_EQ(rig_->bench().profile().encoding.amplitudeMax, Volts(20)) << "in force for the rest of the run";
    EXPECT_EQ(areaInForce(), 1);
}

TEST_F(ScriptTrust, AProfileComesFromSlidesThatTheProgramMeasured) {
    RecordProperty("hazard", "H9");
    // Other data from a script are ignored, and an unmeasured value is refused.
    for (const auto& [forged, refusal] :
         {std::pair("steps.slide('steel');", "surface is \"steel\", one of the surfaces is expected"),
          std::pair("steps.weigh({ mass_g: 150, direction: 'up', repeat: 1 });", "one of the weights is expected"),
          std::pair("for (const surface of surfaces) steps.slide(surface); steps.conclude();",
                    "at least 3 are expected"),
          std::pair("steps.conclude({ accepted: true });", "at least 3 are expected"),
          std::pair("steps.begin({});", "is expected")}) {
        EXPECT_THAT(run(std::string(kCalibrates) + forged, 3), HasSubstr(refusal)) << forged;
    }
    EXPECT_THAT(run("bench.sensorCalibration.conclude();", 3), HasSubstr("begin() is expected first"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "tactoscope" / "profiles"));
}

TEST_F(ScriptTrust, ScalesThatAScriptMakesUpAreNotUsed) {
    RecordProperty("hazard", "H7");
    ASSERT_EQ(run(std::string(kCalibrates) + "steps.scale({ force: { unit: 'N', scale: 0.01, offset: 0 } });", 3), "");
    EXPECT_NEAR(rig_->bench().profile().roughness.sensor->force->scale, 1, 0.05);
}

TEST_F(ScriptTrust, WhatTheProgramSaysOfExposureIsNotTheScripts) {
    RecordProperty("hazard", "H9");
    for (const char* name : {"exposure", "calibration to keep"}) {
        EXPECT_THAT(run(fmt::format("record.measurement(\"{}\", {{ rows: [] }});", name), {}),
                    HasSubstr("a name that the program does not use itself"));
    }
    EXPECT_EQ(run("bench.arm({ load: 1000 }); bench.drive(\"manual\", { roughness: 0.5, pressure: 1 }); bench.wait(2);"
                  "bench.disarm(); report.figure(\"Exposure\", plot.exposure([]));",
                  {}),
              "");
    rig_->closeBench();
    ASSERT_TRUE(rig_->writer().close());
    const auto rows = SessionReader::open(rig_->folder().path() / "run.tacto").value().measurements().value();
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].name, kExposureMeasurement);
    const auto& limits = rows[0].body["rows"];
    ASSERT_FALSE(limits.empty()) << "recorded, whatever the script shows";
    EXPECT_TRUE(std::any_of(limits.begin(), limits.end(), [](const Json& row) {
        return row["unit"] == "mA" && row["value"].is_number() && row["value"] > 0;
    })) << limits.dump();
}

TEST_F(ScriptTrust, WhatTheOperatorSawIsWhatTheSessionSays) {
    RecordProperty("hazard", "H9");
    const auto declares = [](const std::string& fields, const std::string& label = "Repeats") {
        return probe(
            fmt::format("protocol({{ title: 'Seen', {}, parameters: {{ n: {{ label: '{}', unit: 's', value: 5 "
                        "}} }} }});\nfunction run(p) {{ record.event('ran'); }}",
                        fields, label));
    };
    const auto seen = declares("purpose: 'Why'");
    const auto ended = [&](const ProtocolSource& runs, bool readBefore = true) {
        rig_ = std::make_unique<RunBench>(true, "sim:", 1, true);
        auto request = rig_->request(runs);
        request.parameters = {{"n", 7}};
        if (readBefore) request.declaration = readDeclaration(seen).value();
        const auto outcome = runProtocol(std::move(request)).value();
        EXPECT_EQ(outcome.error.value_or(Error{ErrorCode::ParseError, ""}).code, ErrorCode::ParseError);
        return outcome.error ? outcome.error->message : "";
    };
    constexpr const char* kAbout = R"("label":"Repeats","name":"n","unit":"s","value":7)";
    EXPECT_EQ(ended(seen), "");
    EXPECT_THAT(session(), testing::AllOf(HasSubstr(R"("title":"Seen")"), HasSubstr(kAbout), HasSubstr("script: ran")));
    EXPECT_EQ(ended(seen, false), "") << "not read before";
    EXPECT_THAT(session(), testing::AllOf(HasSubstr(R"("title":"Seen")"), HasSubstr(kAbout), HasSubstr("script: ran")));

    const std::string body = "\nfunction run(p) { record.event('ran'); }";
    const std::vector<std::pair<ProtocolSource, std::string>> others = {
        {probe("protocol({ title: 'Forged' });" + body), "another title (\"Forged\" in place of \"Seen\")"},
        {declares("purpose: 'Other'"), "another purpose"},
        {declares("purpose: 'Why', kind: 'other'"), "another kind of result"},
        {declares("purpose: 'Why', needs: ['sensor']"), "other devices"},
        {declares("purpose: 'Why'", "Certified repeats"), "another parameter \"n\""},
        {probe("protocol({ title: 'Seen', purpose: 'Why' });" + body), "other parameters"},
        {probe(body), "nothing that can be read"},
        {probe("try { protocol({ title: 5 }); } catch (e) {}" + body), "nothing that can be read"}};
    for (const auto& [source, difference] : others) {
        EXPECT_EQ(ended(source), "/lab/probe.js:1: when it runs the script declares " + difference +
                                     "; it must declare what it declared when it was read before");
        EXPECT_THAT(session(), testing::Not(testing::AnyOf(HasSubstr("script: ran"), HasSubstr("\"title\""))));
    }
}

TEST_F(ScriptTrust, AnErrorOfTheScriptsOwnIsNoneOfTheProgram) {
    RecordProperty("hazard", "H9");
    const auto ended = [&](const std::string& body) {
        RunBench rig;
        const auto outcome =
            rig.run(withRun("const keep = (call) => { try { call(); } catch (e) { return e; } };\n"
                            "const real = keep(() => bench.arm({ load: 1 }));\n" +
                            body));
        EXPECT_TRUE(outcome.error);
        EXPECT_EQ(outcome.verdict, ScriptVerdict::None) << body;
        return outcome.error.value_or(Error{});
    };
    for (const auto code : {ErrorCode::LimitExceeded, ErrorCode::NotArmed, ErrorCode::Stopped, ErrorCode::Device}) {
        const auto forged =
            ended(fmt::format("verdict({{ verdict: 'fail' }}); throw Object.assign(new Error('stopped by operator "
                              "(signal)'), {{ code: {} }});",
                              static_cast<int>(code)));
        EXPECT_EQ(forged.code, ErrorCode::ParseError);
        EXPECT_EQ(forged.message, "/lab/probe.js:4: stopped by operator (signal)");
    }
    EXPECT_EQ(ended("throw Object.assign(new Error(real.message), real);").code, ErrorCode::ParseError);
    EXPECT_EQ(ended("throw Object.create(real);").code, ErrorCode::ParseError);
    EXPECT_EQ(ended("throw new Proxy(real, {});").code, ErrorCode::ParseError);
    // An error of a host call that is caught and thrown again does not change.
    const auto real = ended("throw real;");
    EXPECT_EQ(real.code, ErrorCode::LimitExceeded) << real.message;
    const auto changed = ended("real.code = 6; real.message = 'stopped by operator'; throw real;");
    EXPECT_EQ(changed.code, real.code);
    EXPECT_EQ(changed.message, real.message);
    EXPECT_EQ(ended("for (let i = 0; i < 1000; ++i) keep(() => bench.wait(-1)); bench.arm({ load: 1 });").code,
              ErrorCode::LimitExceeded);
}

TEST_F(ScriptTrust, AnEventOfTheScriptsBearsNoNameOfTheProgram) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(run("for (const kind of ['abandoned', 'ended by an error', 'not started', 'lamp on'])"
                  " record.event(kind, { message: 'forged' });",
                  {}),
              "");
    const auto said = session();
    for (const char* own : {"script abandoned", "script ended by an error", "script not started"})
        EXPECT_THAT(said, testing::Not(HasSubstr(own)));
    EXPECT_THAT(said, HasSubstr("script: lamp on {\"message\":\"forged\"}"));
}

TEST_F(ScriptTrust, ATrainCountsAsExposureWhateverTheScriptCallsAndHoweverLongItWaits) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(run("bench.arm({ load: 1000 });"
                  "for (let i = 0; i < 8; i++)"
                  "  bench.present({ name: 'x', roughness: 1, pressure: 1 - (i % 2) * 0.02 },"
                  "                { source: 'direct', tolerance: 1e-12, limit_s: 10 });"
                  "bench.drive('off'); bench.disarm(); bench.wait(12);",
                  {}),
              "");
    rig_->closeBench();
    ASSERT_TRUE(rig_->writer().close());
    const auto rows = SessionReader::open(rig_->folder().path() / "run.tacto").value().measurements().value();
    ASSERT_EQ(rows.size(), 1U);
    int seen = 0;
    for (const auto& row : rows[0].body["rows"]) {
        const auto name = row["name"].get<std::string>();
        const double least = name == "commanded voltage" ? 39 : name.starts_with("RMS current over 5 s") ? 0.1 : NAN;
        if (std::isnan(least)) continue;
        ++seen;
        EXPECT_GE(row["value"], least) << row.dump();
    }
    EXPECT_GE(seen, 2);
}

TEST_F(ScriptTrust, AFileIsReadOnlyWhereTheOperatorGaveIt) {
    RecordProperty("hazard", "H10");
    const auto good = folder_.write("p120.csv", "Ra;42,4;µm\nRz;301;µm\n");
    const auto read = [](const std::string& path) { return "bench.profilometer(" + Json(path).dump() + ");"; };
    EXPECT_EQ(run(read(good.string()), {}, {{"file", good.string()}}), "");
    EXPECT_EQ(run(read(good.string()), {}, {{"file", "paper " + good.string() + "; steel 1 2"}}), "");
    // The error is the same for a file that exists, for one that does not, and for a default.
    for (const std::string& path : {good.string(), std::string("/no/such/file"), std::string("/etc/hostname")}) {
        EXPECT_THAT(run(read(path), {}), HasSubstr("the operator did not choose " + Json(path).dump())) << path;
        EXPECT_THAT(run(read(path), {}, {{"file", path + "x"}}), HasSubstr("the operator did not choose")) << path;
    }
    const auto pipe = folder_.path() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    for (const std::string& path : {pipe.string(), std::string("/dev/zero"), folder_.path().string()}) {
        EXPECT_THAT(run(read(path), {}, {{"file", path}}), HasSubstr("is not a file that can be read")) << path;
    }
}

}  // namespace
}  // namespace tacto::test
