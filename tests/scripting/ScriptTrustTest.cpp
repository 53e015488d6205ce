// What a script asks for and does not get: a larger electrode, safety fields in a stored profile, files of its own
// choice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/session/SessionReader.h"
#include "tests/scripting/RunBench.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class ScriptTrust : public testing::Test {
protected:
    ScriptTrust() { ::setenv("XDG_DATA_HOME", folder_.path().c_str(), 1); }
    ~ScriptTrust() override { ::unsetenv("XDG_DATA_HOME"); }
    ScriptTrust(const ScriptTrust&) = delete;
    ScriptTrust& operator=(const ScriptTrust&) = delete;

    /// What the run ended with; `area` is the profile's, `given` the operator's --set.
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
    /// Everything the session says, in one text.
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

    ScratchDir folder_;
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
    // Not on the operator's word either: the profile is where it is changed.
    EXPECT_THAT(run("bench.setElectrodeArea(p.area);", 3, {{"area", "4"}}), HasSubstr("4 cm² is larger"));
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

TEST_F(ScriptTrust, AStoredProfileTakesOverTheScalesAndNothingElse) {
    RecordProperty("hazard", "H1");
    const auto roughness = toJson(RoughnessSettings{}).dump();
    const auto error =
        run("bench.setElectrodeArea(1); bench.setEncoding({ amplitude_max_v: 20, pulses: 3 });\n"
            "const roughness = " +
                roughness +
                ";\n"
                "roughness.references.h.smooth = 0.0123;\n"
                "return verdict({ verdict: null, kept: record.sensorProfile({ accepted: true, roughness },"
                " { store: true }) });",
            3);
    ASSERT_EQ(error, "");
    const auto kept = loadProfile(results_["kept"]["file"].get<std::string>()).value();
    EXPECT_NEAR(kept.roughness.h.smooth, 0.0123, 1e-12);
    EXPECT_EQ(kept.electrodeArea, SquareCentimetres(3));
    EXPECT_EQ(kept.encoding, EncodingProfile{});
    EXPECT_EQ(rig_->bench().profile().encoding.amplitudeMax, Volts(20)) << "in force for the rest of the run";
    EXPECT_EQ(areaInForce(), 1);
}

TEST_F(ScriptTrust, AFileIsReadOnlyWhereTheOperatorGaveIt) {
    RecordProperty("hazard", "H10");
    const auto good = folder_.write("p120.csv", "Ra;42,4;µm\nRz;301;µm\n");
    const auto read = [](const std::string& path) { return "bench.profilometer(" + Json(path).dump() + ");"; };
    EXPECT_EQ(run(read(good.string()), {}, {{"file", good.string()}}), "");
    EXPECT_EQ(run(read(good.string()), {}, {{"file", "paper " + good.string() + "; steel 1 2"}}), "");
    // The same words for what is there and what is not, and for a default.
    for (const std::string& path : {good.string(), std::string("/no/such/file"), std::string("/etc/hostname")}) {
        EXPECT_THAT(run(read(path), {}), HasSubstr("the operator did not choose " + Json(path).dump())) << path;
        EXPECT_THAT(run(read(path), {}, {{"file", path + "x"}}), HasSubstr("the operator did not choose")) << path;
    }
    const auto pipe = folder_.path() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    for (const std::string& path : {pipe.string(), std::string("/dev/zero"), folder_.path().string()}) {
        EXPECT_THAT(run(read(path), {}, {{"file", path}}), HasSubstr("is no file that can be read")) << path;
    }
}

}  // namespace
}  // namespace tacto::test
