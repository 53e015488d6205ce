// Hazard H10: a script acts only through the host objects, and cannot remove or replace them.
#include <gtest/gtest.h>

#include "app/scripting/engine/ScriptProcess.h"
#include "tests/scripting/RunBench.h"

namespace tacto {
namespace {

/// Answers every host call with the name of the called function.
class EchoPort final : public HostPort {
public:
    Result<nlohmann::json> call(const HostFunction& function, const nlohmann::json& arguments, int line) override {
        calls.push_back(std::string(function.object) + "." + std::string(function.name));
        given = arguments;
        lastLine = line;
        if (refuse) return fail(ErrorCode::LimitExceeded, "40 V is above 30 V");
        return nlohmann::json("called");
    }
    std::vector<std::string> calls;
    nlohmann::json given;
    int lastLine = 0;
    bool refuse = false;
};

/// Returns the error that ended the script, or "" if run() returned.
std::string outcomeOf(const std::string& script, EchoPort* port = nullptr) {
    EchoPort own;
    const auto process = ScriptProcess::start(std::size_t{1} << 30).value();
    if (auto error = process->load(port != nullptr ? *port : own, test::probe(script))) return error->text();
    if (auto error = process->run(nlohmann::json::object())) return error->text();
    return {};
}

TEST(Sandbox, CallsHostFunctionsWithCopiesOfPlainData) {
    EchoPort port;
    EXPECT_EQ(
        outcomeOf(
            "function run() {\n if (bench.wait(0.5, { a: [1, null, NaN], u: undefined }) !== 'called') throw 1;\n}",
            &port),
        "");
    ASSERT_EQ(port.calls, std::vector<std::string>{"bench.wait"});
    EXPECT_EQ(port.lastLine, 2);
    EXPECT_EQ(port.given[0], 0.5);
    EXPECT_TRUE(std::isnan(port.given[1]["a"][2].get<double>()));
    EXPECT_FALSE(port.given[1].contains("u"));
}

TEST(Sandbox, ThrowsTheOperatorsSentenceAsAnErrorThatCanBeCaught) {
    EchoPort port;
    port.refuse = true;
    EXPECT_EQ(outcomeOf("function run() {\n\n bench.wait(1);\n}", &port), "/lab/probe.js:3: 40 V is above 30 V");
    EXPECT_EQ(outcomeOf("function run() { try { bench.wait(1); } catch (e) {\n"
                        " if (!(e instanceof Error) || e.message !== '40 V is above 30 V') throw 'wrong'; } }",
                        &port),
              "");
}

struct Attempt {
    const char* name;
    const char* code;  ///< the body of run()
};

class SandboxRefuses : public ::testing::TestWithParam<Attempt> {};

TEST_P(SandboxRefuses, TheAttempt) {
    RecordProperty("hazard", "H10");
    EchoPort port;
    const std::string error = outcomeOf(std::string("function run(p) {\n") + GetParam().code + "\n}", &port);
    EXPECT_TRUE(error.starts_with("/lab/probe.js:2: ")) << "ended with: " << error;
    EXPECT_TRUE(port.calls.empty());
}

INSTANTIATE_TEST_SUITE_P(
    H10, SandboxRefuses,
    ::testing::Values(
        // files, modules, network, the program
        Attempt{"Require", "require('fs')"}, Attempt{"ImportModule", "importModule('/etc/passwd')"},
        Attempt{"QtObject", "Qt.openUrlExternally('file:///etc/passwd')"},
        Attempt{"QtInclude", "Qt.include('/etc/passwd')"}, Attempt{"Include", "include('/etc/passwd')"},
        Attempt{"XmlHttpRequest", "new XMLHttpRequest()"}, Attempt{"Fetch", "fetch('http://localhost')"},
        Attempt{"WebSocket", "new WebSocket('ws://localhost')"}, Attempt{"Url", "new URL('file:///etc/passwd')"},
        Attempt{"Process", "process.exit(1)"}, Attempt{"Console", "console.log(1)"}, Attempt{"Print", "print(1)"},
        Attempt{"Load", "load('/etc/passwd')"}, Attempt{"CollectGarbage", "gc()"}, Attempt{"Qml", "Component.create()"},
        Attempt{"Promise", "Promise.resolve(1)"}, Attempt{"AtomicsWait", "Atomics.wait()"},
        Attempt{"FunctionConstructor", "new Function('return require')()"},
        Attempt{"IndirectEval", "(0, eval)('importModule')"},
        // overwriting objects of the program
        Attempt{"AssignBench", "bench = {}"}, Attempt{"AssignVerdict", "verdict = () => 'pass'"},
        Attempt{"AssignMember", "bench.wait = () => 0"}, Attempt{"AddMember", "bench.extra = 1"},
        Attempt{"DeleteMember", "delete bench.wait"}, Attempt{"AssignSteps", "bench.loadSafety = {}"},
        Attempt{"AssignStep", "bench.loadSafety.load = () => 0"}, Attempt{"AddStep", "bench.loadSafety.extra = 1"},
        Attempt{"DefineMember", "Object.defineProperty(bench, 'wait', { value: 1 })"},
        Attempt{"DefineGlobal", "Object.defineProperty(Function('return this')(), 'bench', { value: 1 })"},
        Attempt{"DeleteGlobal", "delete (Function('return this')()).bench"},
        Attempt{"AssignGlobal", "(Function('return this')()).bench = 1"},
        Attempt{"ReplacePrototype", "Object.setPrototypeOf(bench, { wait: 1 })"},
        Attempt{"ProtoAssignment", "bench.wait.__proto__ = {}"}, Attempt{"FunctionMember", "bench.wait.call = 1"},
        Attempt{"AssignConditions", "bench.conditions = []"}, Attempt{"MathRandom", "Math.random = () => 0.5"}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(Sandbox, RefusesImportStatements) {
    RecordProperty("hazard", "H10");
    for (const char* code : {"import x from '/etc/passwd';", "import '/etc/passwd.mjs';", "export const x = 1;",
                             ".import \"/etc/passwd.js\" as X", "import('/etc/passwd');"}) {
        const std::string error = outcomeOf(std::string("\n") + code + "\nfunction run() {}");
        EXPECT_TRUE(error.starts_with("/lab/probe.js:2: SyntaxError")) << code << " gave: " << error;
    }
}

TEST(Sandbox, RefusesTopLevelNamesThatHideTheProgramsOwn) {
    RecordProperty("hazard", "H10");
    for (const char* code : {"let bench = {};", "const verdict = () => 'pass';", "var bench = {};",
                             "function bench() {}", "class analysis {}", "let record;"}) {
        EXPECT_NE(outcomeOf(std::string(code) + "\nfunction run() {}"), "") << code;
    }
}

TEST(Sandbox, ShowsNothingOfTheObjectBehindIt) {
    RecordProperty("hazard", "H10");
    EXPECT_EQ(outcomeOf(R"js(function run() {
        const own = ["arm", "calibration", "capture", "conditions", "devices", "disarm", "drive", "encodingComparison",
                     "exposure", "fitLoad", "lift", "live", "loadSafety", "loads", "measureReference", "measureRest",
                     "measureWeight", "present", "profilometer", "readKnownLoad", "readReference",
                     "sensorCalibration", "setElectrodeArea", "setEncoding", "setReferences",
                     "stimulatorCalibration", "time", "totals", "transitions", "useCalibration", "variation",
                     "wait", "watch"];
        if (Object.getOwnPropertyNames(bench).sort().join() !== own.join()) {
            throw Object.getOwnPropertyNames(bench).sort().join();
        }
        for (const held of [bench, bench.loadSafety, bench.variation]) {
            if (Object.getPrototypeOf(held) !== null) throw "an object of the bench has a prototype";
            if (!Object.isFrozen(held)) throw "an object of the bench is not frozen";
        }
        for (const name of ["objectName", "deleteLater", "destroyed", "destroy", "call"]) {
            if (bench[name] !== undefined) throw name;
        }
        let seen = [];
        const apply = Function.prototype.apply, call = Function.prototype.call;
        Function.prototype.apply = function () { seen.push(this); };
        Function.prototype.call = function () { seen.push(this); };
        Array.prototype[Symbol.iterator] = function () { seen.push(this); };
        Object.defineProperty(Object.prototype, "toJSON", { get() { seen.push(this); } });
        Object.defineProperty(Array.prototype, "0", { set(x) { seen.push(x); }, configurable: true });
        bench.wait(1);
        delete Array.prototype[0];
        if (seen.length > 0) throw "a script's function saw the call";
    })js"),
              "");
}

TEST(Sandbox, LeavesOnlyEcmaScriptAndTheHostObjectsAsGlobals) {
    RecordProperty("hazard", "H10");
    EXPECT_EQ(outcomeOf(R"js(function run() {
        const foreign = ["Qt", "console", "print", "gc", "importModule", "XMLHttpRequest", "URL", "URLSearchParams",
                         "Promise", "SharedArrayBuffer", "Atomics", "qsTr", "Component", "host", "table"];
        const world = Function("return this")();
        for (const name of foreign) if (name in world) throw name;
        for (const name of ["bench", "operator", "analysis", "report", "random", "record", "measure", "plot",
                            "protocol", "progress", "verdict", "log"]) {
            const held = Object.getOwnPropertyDescriptor(world, name);
            if (!held || held.writable || held.configurable) throw name;
            if (!Object.isFrozen(world[name])) throw name + " is not frozen";
        }
    })js"),
              "");
}

TEST(Sandbox, NamesFileLineAndReasonOfEveryKindOfError) {
    EXPECT_EQ(outcomeOf("function run() {\n\nthrow 'the load is wet';\n}"), "/lab/probe.js:3: the load is wet");
    EXPECT_EQ(outcomeOf("function f() {\n throw 42;\n}\nfunction run() { f(); }"), "/lab/probe.js:2: 42");
    EXPECT_EQ(outcomeOf("function run() {\n throw { load: 'wet' };\n}"), "/lab/probe.js:2: {\"load\":\"wet\"}");
    EXPECT_EQ(outcomeOf("function run() {\n throw new Error('wet');\n}"), "/lab/probe.js:2: wet");
    EXPECT_EQ(outcomeOf("function run() {\n throw null;\n}"), "/lab/probe.js:2: null");
    EXPECT_EQ(outcomeOf("function run() {\n throw undefined;\n}"), "/lab/probe.js:2: undefined");
    EXPECT_EQ(outcomeOf("function run() {\n load.me();\n}"), "/lab/probe.js:2: ReferenceError: load is not defined");
    EXPECT_EQ(outcomeOf("\n\nthrow 'early';\nfunction run() {}"), "/lab/probe.js:3: early");
    EXPECT_TRUE(outcomeOf("function run() {\n if (\n}").starts_with("/lab/probe.js:3: SyntaxError"));
    EXPECT_TRUE(outcomeOf("function f() { f(); }\nfunction run() { f(); }").starts_with("/lab/probe.js:1: RangeError"));
    EXPECT_EQ(outcomeOf("let x = 1;"), "/lab/probe.js:1: the script has no function run(p)");
}

TEST(Sandbox, TakesRunHoweverItIsDefined) {
    EXPECT_EQ(outcomeOf("const run = (p) => {\n throw 'here';\n};"), "/lab/probe.js:2: here");
    EXPECT_EQ(outcomeOf("let run = function (p) {\n throw 'here';\n} // no line end"), "/lab/probe.js:2: here");
    EXPECT_EQ(outcomeOf("var run = 5;"), "/lab/probe.js:1: the script has no function run(p)");
}

TEST(Sandbox, ReturningAnErrorIsNotThrowingOne) {
    EXPECT_EQ(outcomeOf("function run() { return new Error('x'); }"), "");
}

TEST(Sandbox, RefusesArgumentsThatAreNoPlainData) {
    EchoPort port;
    EXPECT_NE(outcomeOf("function run() {\n bench.wait(() => 1);\n}", &port), "");
    EXPECT_NE(outcomeOf("function run() {\n const a = []; a[0] = a; bench.wait(a);\n}", &port), "");
    EXPECT_TRUE(port.calls.empty());
}

}  // namespace
}  // namespace tacto
