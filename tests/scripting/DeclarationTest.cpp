#include <gtest/gtest.h>

#include "app/scripting/engine/ProtocolDeclaration.h"
#include "core/analysis/variation/VirtualParticipant.h"
#include "tests/scripting/RunBench.h"
#include "tests/support/InTime.h"

namespace tacto {
namespace {

using test::probe;

constexpr const char* kFull = R"js(protocol({
  title: "Probe", purpose: "Does it hold?", kind: "separability", needs: ["stimulator", "oscilloscope"],
  parameters: {
    zeta: { label: "Repeats", type: "integer", min: 5, max: 500, value: 25 },
    load: { label: "Load", unit: "ohm", min: 100, max: 100e3, value: 1e3 },
    source: { type: "choice", choices: { ruler: "a ruler", finger: "a finger" }, value: "finger" },
    note: { type: "text", value: "" },
    quick: { type: "boolean", value: false },
  },
});
function run(p) {
  operator.confirm("wiring", "Check the wiring");
  operator.enter('room temperature', "Enter it");
  bench.fitLoad("500 ohm");
}
)js";

std::string errorOf(const std::string& declaration) {
    auto read = readDeclaration(probe("\n" + declaration + "\nfunction run() {}"));
    return read ? "" : read.error().message;
}
std::string parameterError(const std::string& parameter) {
    return errorOf("protocol({ title: 'x', parameters: { load: " + parameter + " } });");
}

TEST(ProtocolDeclaration, ReadsEverythingInTheOrderWritten) {
    const auto read = readDeclaration(probe(kFull)).value();
    EXPECT_EQ(read.name, "probe");
    EXPECT_EQ(read.title, "Probe");
    EXPECT_EQ(read.purpose, "Does it hold?");
    EXPECT_EQ(read.kind, "separability");
    EXPECT_EQ(read.needs, (std::set<Role>{Role::Stimulator, Role::Oscilloscope}));
    ASSERT_EQ(read.parameters.size(), 5U);
    EXPECT_EQ(read.parameters[0].name, "zeta");
    EXPECT_EQ(read.parameters[0].type, ParameterType::Integer);
    EXPECT_EQ(read.parameters[0].value, 25);
    EXPECT_EQ(read.parameters[1].unit, "ohm");
    EXPECT_EQ(read.parameters[1].max, 100e3);
    EXPECT_EQ(read.parameters[2].choices,
              (std::vector<std::pair<std::string, std::string>>{{"ruler", "a ruler"}, {"finger", "a finger"}}));
    EXPECT_EQ(read.parameters[3].type, ParameterType::Text);
    EXPECT_EQ(read.parameters[4].type, ParameterType::Boolean);
    EXPECT_EQ(read.questions, (std::vector<std::string>{"wiring", "room temperature", "fit-load"}));
    EXPECT_FALSE(read.hasOtherQuestions);
}

TEST(ProtocolDeclaration, KnowsWhatTheHostAsksOnItsOwn) {
    const auto read = readDeclaration(probe(R"js(protocol({ title: "x" });
function run() { operator.wired(500); bench.arm({ load: 500 }); bench.present("silk"); })js"));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->questions, (std::vector<std::string>{"wiring", "confirm-arming", "surface-*"}));
}

TEST(ProtocolDeclaration, NamesTheConfirmationOfArmingWhicheverFunctionArms) {
    RecordProperty("hazard", "H12");
    for (const char* call :
         {"bench.loadSafety.trip('open')", "bench . loadSafety . silence()", "bench.transitions.knownLoad()",
          "bench.stimulatorCalibration . read(level)", "bench.stimulatorCalibration.knownLoad(p)",
          "bench.stimulatorCalibration.levels('gap')", "bench.readKnownLoad(1000, 5)"}) {
        const auto read =
            readDeclaration(probe(fmt::format("protocol({{ title: 'x' }});\nfunction run(p) {{ {}; }}", call)));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->questions, (std::vector<std::string>{"confirm-arming"})) << call;
    }
    const auto read = readDeclaration(
        probe("protocol({ title: 'x' });\nfunction run(p) { bench.disarm(); bench.loadSafety.silenced(); }"));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(read->questions.empty());
}

TEST(ProtocolDeclaration, IsWrittenAsTheCommandLinePromises) {
    const auto json = toJson(readDeclaration(probe(kFull)).value());
    EXPECT_EQ(json["name"], "probe");
    EXPECT_EQ(json["title"], "Probe");
    EXPECT_EQ(json["needs"], (nlohmann::json{"stimulator", "oscilloscope"}));
    EXPECT_EQ(json["parameters"][1], (nlohmann::json{{"name", "load"},
                                                     {"label", "Load"},
                                                     {"type", "number"},
                                                     {"unit", "ohm"},
                                                     {"min", 100},
                                                     {"max", 100e3},
                                                     {"value", 1000}}));
}

TEST(ProtocolDeclaration, StatesItsViewOrHasTheOneOfItsKindAndDevices) {
    const auto viewOf = [](const std::string& more) {
        return readDeclaration(probe("protocol({ title: 'x', " + more + " });\nfunction run() {}")).value().view;
    };
    EXPECT_EQ(viewOf("needs: ['sensor'], view: 'trials'"), ProtocolView::Trials);
    EXPECT_EQ(viewOf("kind: 'load-safety', view: 'none'"), ProtocolView::None);
    EXPECT_EQ(viewOf("kind: 'load-safety'"), ProtocolView::Loads);
    EXPECT_EQ(viewOf("kind: 'stimulator-calibration'"), ProtocolView::Calibration);
    EXPECT_EQ(viewOf("needs: ['oscilloscope']"), ProtocolView::Trials);
    EXPECT_EQ(viewOf("needs: ['sensor']"), ProtocolView::Slides);
    EXPECT_EQ(viewOf("needs: []"), ProtocolView::None);
    EXPECT_EQ(errorOf("protocol({ title: 'x', view: 'map' });"),
              "/lab/probe.js:2: view is \"map\"; trials, loads, calibration, slides or none is expected");
}

TEST(ProtocolDeclaration, NamesFileLineAndWhatIsWrong) {
    EXPECT_EQ(errorOf("protocol({ title: 'x', tilte: 1 });"),
              "/lab/probe.js:2: protocol(): \"tilte\" is not a known key; accepted are title, purpose, kind, needs, "
              "view, parameters");
    EXPECT_EQ(errorOf("protocol({});"), "/lab/probe.js:2: protocol(): title is missing, a text is expected");
    EXPECT_EQ(errorOf("protocol({ title: 'x', needs: ['laser'] });"),
              "/lab/probe.js:2: \"needs\" contains \"laser\"; only sensor, stimulator, oscilloscope, massager can be "
              "needed");
    EXPECT_EQ(errorOf("const x = 1;"), "/lab/probe.js:1: the script does not call protocol({ title: ... })");
    EXPECT_NE(errorOf("protocol({ title: 'x' }); protocol({ title: 'y' });"), "");
    EXPECT_NE(errorOf("protocol();"), "");
    EXPECT_NE(errorOf("protocol([1]);"), "");
    EXPECT_EQ(errorOf("protocol({ title: 'x' }); bench.disarm();"),
              "/lab/probe.js:2: bench.disarm can be used inside run(p) only");
    EXPECT_EQ(errorOf("protocol({ title: 'x' }); throw 'no';"), "/lab/probe.js:2: no");
}

TEST(ProtocolDeclaration, RefusesParametersThatContradictThemselves) {
    EXPECT_EQ(parameterError("{ value: 5, min: 10 }"),
              "/lab/probe.js:2: the default of load is 5, a number of 10 or more is expected");
    EXPECT_EQ(parameterError("{ value: 5, min: 10, max: 1 }"),
              "/lab/probe.js:2: parameter load: min 10 is above max 1");
    EXPECT_EQ(parameterError("{ min: 1 }"), "/lab/probe.js:2: parameter load has no default: \"value\" is missing");
    EXPECT_EQ(parameterError("{ value: 1.5, type: 'integer' }"),
              "/lab/probe.js:2: the default of load is 1.5, a whole number is expected");
    EXPECT_NE(parameterError("{ value: 1, type: 'float' }"), "");
    EXPECT_NE(parameterError("{ value: NaN }"), "");
    EXPECT_NE(parameterError("{ value: Infinity }"), "");
    EXPECT_NE(parameterError("{ value: 1, max: NaN }"), "");
    EXPECT_NE(parameterError("{ value: 'a', type: 'choice', choices: { b: 'B', c: 'C' } }"), "");
    EXPECT_NE(parameterError("{ value: 'b', type: 'choice', choices: { b: 'B' } }"), "");
    EXPECT_NE(parameterError("{ value: 1, units: 'ohm' }"), "");
    EXPECT_NE(parameterError("7"), "");
}

TEST(ProtocolDeclaration, ANumberForAnOptionHasItsUnitAndRange) {
    const auto read = readDeclaration(probe(R"js(protocol({ title: "x", parameters: {
  felt: { option: "analysis.variation.detection_ma", value: 3.5 },
  people: { type: "integer", option: "analysis.variation.participants", value: 5 },
} });
function run() {})js"));
    ASSERT_TRUE(read) << read.error().message;
    const auto fields = populationFields();
    const auto felt = std::ranges::find(fields, "detection_ma", &PopulationField::key);
    ASSERT_NE(felt, fields.end());
    EXPECT_EQ(read->parameters[0].unit, "mA");
    EXPECT_EQ(read->parameters[0].min, felt->accepted.low);
    EXPECT_EQ(read->parameters[0].max, felt->accepted.high);
    EXPECT_EQ(read->parameters[1].type, ParameterType::Integer);
    EXPECT_EQ(parameterError("{ option: 'analysis.variation.detection_ma', value: 1e6 }"),
              "/lab/probe.js:2: the default of load is 1000000, a number from 0.01 to 100 mA is expected");
    EXPECT_EQ(parameterError("{ option: 'analysis.variation.detection_ma', max: 5, value: 1 }"),
              "/lab/probe.js:2: parameter load: max is given, and the option analysis.variation.detection_ma has its "
              "own");
    for (const auto* none : {"analysis.variation.levels", "analysis.variation.participants",
                             "analysis.variation.thirst", "analysis.detection_ma", "detection_ma"}) {
        EXPECT_NE(parameterError(fmt::format("{{ option: '{}', value: 1 }}", none)), "") << none;
    }
}

TEST(ProtocolDeclaration, KnowsDaysFilesTheReferenceAndWhatTheVerdictNeeds) {
    const auto read = readDeclaration(probe(R"js(protocol({ title: "x", parameters: {
  due: { type: "date", value: "2027-03-01", step: "reference" },
  table: { type: "file", value: "" },
  area: { label: "electrode", unit: "cm2", value: 0, needed: "density is not evaluated", zero: "from the profile" },
} });
function run() {})js"));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->parameters[0].type, ParameterType::Date);
    EXPECT_TRUE(read->parameters[0].reference);
    EXPECT_EQ(read->parameters[1].type, ParameterType::File);
    EXPECT_FALSE(read->parameters[1].reference);
    EXPECT_EQ(read->parameters[2].needed, "density is not evaluated");
    EXPECT_EQ(parseSetting(read->parameters[0], "2028-02-29").value(), "2028-02-29");
    EXPECT_EQ(parseSetting(read->parameters[0], "").value(), "") << "not stated";
    EXPECT_EQ(parseSetting(read->parameters[0], "2027-02-29").error().message,
              "due is 2027-02-29, a day such as 2027-03-01, or nothing, is expected");
    const auto json = toJson(*read);
    EXPECT_EQ(json["parameters"][0]["type"], "date");
    EXPECT_EQ(json["parameters"][0]["step"], "reference");
    EXPECT_EQ(json["parameters"][2]["needed"], "density is not evaluated");
    EXPECT_EQ(json["parameters"][2]["zero"], "from the profile");
    EXPECT_EQ(parameterError("{ value: 1, min: 0.5, zero: 'none' }"),
              "/lab/probe.js:2: parameter load: zero says what 0 stands for, and 0 is not accepted");
    EXPECT_NE(parameterError("{ value: '', type: 'text', zero: 'none' }"), "");
    EXPECT_EQ(parameterError("{ value: 1, step: 'settings' }"),
              "/lab/probe.js:2: parameter load: step is \"settings\", reference is expected, or none");
    EXPECT_NE(parameterError("{ value: 'soon', type: 'date' }"), "");
}

TEST(ProtocolDeclaration, RefusesTextsThatAreTooLong) {
    RecordProperty("hazard", "H9");
    const auto of = [](std::size_t count) { return "'" + std::string(count, 'x') + "'"; };
    EXPECT_EQ(errorOf("protocol({ title: " + of(200) + ", purpose: " + of(2000) + " });"), "");
    EXPECT_EQ(errorOf("protocol({ title: " + of(201) + " });"),
              "/lab/probe.js:2: protocol(): title has 201 characters, at most 200 are accepted");
    EXPECT_EQ(errorOf("protocol({ title: 'x', purpose: " + of(2001) + " });"),
              "/lab/probe.js:2: protocol(): purpose has 2001 characters, at most 2000 are accepted");
    for (const char* key : {"label", "unit"}) {
        EXPECT_EQ(parameterError(fmt::format("{{ value: 5, {}: {} }}", key, of(2000))), "");
        EXPECT_EQ(
            parameterError(fmt::format("{{ value: 5, {}: {} }}", key, of(2001))),
            fmt::format("/lab/probe.js:2: parameter load: {} has 2001 characters, at most 2000 are accepted", key));
    }
    EXPECT_EQ(parameterError("{ type: 'text', value: " + of(2001) + " }"),
              "/lab/probe.js:2: parameter load: value has 2001 characters, at most 2000 are accepted");
    EXPECT_EQ(parameterError("{ value: 'a', choices: { a: 'A', b: " + of(2001) + " } }"),
              "/lab/probe.js:2: parameter load: a choice has 2001 characters, at most 2000 are accepted");
    EXPECT_EQ(errorOf("protocol({ title: 'x', parameters: { [" + of(201) + "]: { value: 1 } } });"),
              "/lab/probe.js:2: parameters: a name has 201 characters, at most 200 are accepted");
}

TEST(ProtocolDeclaration, EndsAReaderThatAnswersMoreThanIsAccepted) {
    RecordProperty("hazard", "H9");
    const auto read = readDeclaration(probe("const all = {}, text = 'x'.repeat(2000);"
                                            "for (let i = 0; i < 3000; ++i) all['p' + i] = { value: 1, label: text };"
                                            "protocol({ title: 'x', parameters: all });\nfunction run() {}"),
                                      std::chrono::seconds(20));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message,
              "/lab/probe.js:1: the lines outside run(p) declare more than the 4000000 bytes that are accepted");
}

TEST(ProtocolDeclaration, InterruptsATopLevelThatDoesNotEnd) {
    RecordProperty("hazard", "H10");
    const auto begin = std::chrono::steady_clock::now();
    const auto read = readDeclaration(probe("protocol({ title: 'x' }); for (;;) {}"), std::chrono::milliseconds(100));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::Timeout);
    EXPECT_TRUE(read.error().message.starts_with("/lab/probe.js:1: ")) << read.error().message;
    EXPECT_IN_TIME(std::chrono::steady_clock::now() - begin < std::chrono::seconds(3));
}

TEST(ProtocolDeclaration, ATopLevelThatMakesTheEngineCrashEndsNoProgramButTheReader) {
    RecordProperty("hazard", "H10");
    int refused = 0;
    for (const char* crash : {"new RegExp('('.repeat(2e5) + ')'.repeat(2e5));",
                              "let a = []; for (let i = 0; i < 1e6; i++) a = [a]; String(a);",
                              "function* g() { yield* g(); } for (const x of g()) ;",
                              "const p = {}; const q = new Proxy(p, {}); Object.setPrototypeOf(p, q); p.nothing;"}) {
        const auto read = readDeclaration(probe(std::string(crash) + " protocol({ title: 'x' }); function run() {}"));
        if (read) continue;  // this engine version handles the script
        ++refused;
        EXPECT_TRUE(read.error().message.starts_with("/lab/probe.js:1: ")) << read.error().message;
        EXPECT_TRUE(read.error().code == ErrorCode::ParseError || read.error().code == ErrorCode::Timeout);
    }
    EXPECT_GE(refused, 1) << "nothing here makes this engine crash: find what does";
}

TEST(ProtocolSettings, AreTypedAndChecked) {
    const auto declaration = readDeclaration(probe(kFull)).value();
    const auto applied = applySettings(declaration, {{"zeta", "30"},
                                                     {"load", "2.2 kohm"},
                                                     {"source", "ruler"},
                                                     {"note", "a = b"},
                                                     {"quick", "true"},
                                                     {"wiring", "yes"}})
                             .value();
    EXPECT_EQ(
        applied.parameters,
        (nlohmann::json{{"zeta", 30}, {"load", 2200.0}, {"source", "ruler"}, {"note", "a = b"}, {"quick", true}}));
    EXPECT_EQ(applied.answers, (std::map<std::string, std::string>{{"wiring", "yes"}}));
}

TEST(ProtocolSettings, AreRefusedInOneSentenceWithKeyValueAndRange) {
    const auto declaration = readDeclaration(probe(kFull)).value();
    const auto error = [&](const char* key, const char* value) {
        auto applied = applySettings(declaration, {{key, value}});
        return applied ? std::string() : applied.error().message;
    };
    EXPECT_EQ(error("zeta", "4"), "zeta is 4, a whole number from 5 to 500 is expected");
    EXPECT_EQ(error("zeta", "5.5"), "zeta is 5.5, a whole number from 5 to 500 is expected");
    EXPECT_EQ(error("load", "heavy"), "load is heavy, a number from 100 to 100000 ohm is expected");
    EXPECT_EQ(error("load", "nan"), "load is NaN, a number from 100 to 100000 ohm is expected");
    EXPECT_EQ(error("load", "inf"), "load is Infinity, a number from 100 to 100000 ohm is expected");
    EXPECT_EQ(error("load", ""), "load is , a number from 100 to 100000 ohm is expected");
    EXPECT_EQ(error("source", "toe"), "source is toe, one of ruler, finger is expected");
    EXPECT_EQ(error("quick", "perhaps"), "quick is perhaps, true or false is expected");
    EXPECT_EQ(
        error("repaets", "5"),
        "probe has no parameter repaets; it has zeta, load, source, note, quick, wiring, room temperature, fit-load");
}

TEST(ProtocolSettings, RefuseAWholeNumberThatADoubleDoesNotHold) {
    RecordProperty("hazard", "H9");
    const auto declaration =
        readDeclaration(probe("protocol({ title: 'x', parameters: { n: { type: 'integer', value: 1 }, "
                              "k: { type: 'integer', min: 5, max: 1e300, value: 5 } } });\nfunction run() {}"))
            .value();
    const auto error = [&](const char* key, const char* value) {
        auto applied = applySettings(declaration, {{key, value}});
        return applied ? std::string() : applied.error().message;
    };
    EXPECT_EQ(error("n", "1e300"),
              "n is 1e+300, a whole number from -9007199254740992 to 9007199254740992 is expected");
    EXPECT_NE(error("n", "-1e300"), "");
    EXPECT_NE(error("n", "9007199254740994"), "");
    EXPECT_EQ(error("k", "1e300"), "k is 1e+300, a whole number from 5 to 9007199254740992 is expected");
    EXPECT_EQ(error("n", "9007199254740992"), "");
    EXPECT_EQ(error("n", "-9007199254740992"), "");
    EXPECT_NE(parameterError("{ type: 'integer', value: 1e300 }"), "");
}

TEST(ProtocolSettings, TakeKeysThatBeginAsTheScriptsText) {
    const auto declaration = readDeclaration(probe("protocol({ title: 'x' });\nfunction run(p) {\n"
                                                   "for (const n of ['a', 'b']) operator.enter('dmm-' + n, 'R?'); }"))
                                 .value();
    EXPECT_FALSE(declaration.hasOtherQuestions);
    EXPECT_EQ(declaration.questions, std::vector<std::string>{"dmm-*"});
    EXPECT_EQ(applySettings(declaration, {{"dmm-b", "500"}}).value().answers.at("dmm-b"), "500");
    EXPECT_EQ(applySettings(declaration, {{"dnm-b", "500"}}).error().message,
              "probe has no parameter dnm-b; it has dmm-*");
}

TEST(ProtocolSettings, TakeAnyKeyWhereQuestionNamesAreComputed) {
    const auto declaration = readDeclaration(probe("protocol({ title: 'x' });\nfunction run(p) {\n"
                                                   "for (const n of ['a', 'b']) operator.confirm(n, 'Sure?'); }"))
                                 .value();
    EXPECT_TRUE(declaration.hasOtherQuestions);
    EXPECT_EQ(applySettings(declaration, {{"b", "yes"}}).value().answers.at("b"), "yes");
}

TEST(Declaration, AParameterByWhichTheOperatorVouchesSaysForWhat) {
    testing::Test::RecordProperty("hazard", "H1");
    const auto declare = [](const std::string& area) {
        ProtocolSource source;
        source.name = "vouch";
        source.text = "protocol({ title: 'T', needs: [], parameters: { area: " + area + " } }); function run(p) {}";
        return readDeclaration(source);
    };
    EXPECT_TRUE(declare("{ label: 'Smallest electrode', unit: 'cm2', min: 0, max: 1000, value: 0 }"));
    const auto lies = declare("{ label: 'Seconds per trial', unit: 's', min: 0, max: 1000, value: 0 }");
    ASSERT_FALSE(lies);
    EXPECT_NE(lies.error().message.find("Seconds per trial"), std::string::npos);
    EXPECT_FALSE(declare("{ label: 'Smallest electrode', unit: 'm2', min: 0, max: 1000, value: 0 }"));
}

}  // namespace
}  // namespace tacto
