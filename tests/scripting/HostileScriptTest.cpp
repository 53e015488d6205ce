// A script's process may crash, hang, flood or lie. The run then ends with one sentence and the output off, while
// bench, gate and session continue (hazard H10).
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <future>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <thread>
#include <unistd.h>

#include "app/scripting/engine/ScriptProcess.h"
#include "core/base/ProgramStart.h"
#include "core/session/SessionVerify.h"
#include "tests/scripting/RunBench.h"
#include "tests/support/InTime.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::HasSubstr;

const std::string kDelivering =
    "bench.arm({ load: 1000 }); bench.drive('manual', { roughness: 1, pressure: 1 }); bench.wait(0.6); log('armed');\n";

/// The results of a run.
struct Left {
    ScriptOutcome outcome;
    bool off = false;
    bool recorded = false;  ///< the session is closed and valid
};

Left runToItsEnd(RunBench& rig, RunRequest request, milliseconds most = std::chrono::seconds(20)) {
    Left left;
    auto run = ScriptRun::start(std::move(request)).value();
    if (!run->waitFor(most)) run->stop("the test");
    left.outcome = run->wait();
    run.reset();
    left.off = rig.outputOff();
    rig.closeBench();
    left.recorded = rig.writer().close().has_value();
    const auto kept = verifySession(rig.folder().path() / "run.tacto");
    left.recorded = left.recorded && kept && kept->status == SessionStatus::Intact;
    return left;
}

Left runToItsEnd(const std::string& body) {
    RunBench rig(true, "sim:", 1, true);
    return runToItsEnd(rig, rig.request(withRun(kDelivering + body)));
}

class CrashingScript : public testing::TestWithParam<const char*> {};

TEST_P(CrashingScript, EndsItsRunAndNothingElse) {
    RecordProperty("hazard", "H10");
    const auto left = runToItsEnd(GetParam());
    EXPECT_TRUE(left.off);
    EXPECT_TRUE(left.recorded);
    ASSERT_TRUE(left.outcome.error);
    EXPECT_THAT(left.outcome.error->message, testing::StartsWith("/lab/probe.js:"));
    EXPECT_EQ(left.outcome.error->message.find('\n'), std::string::npos) << "one sentence";
    EXPECT_NE(left.outcome.verdict, ScriptVerdict::Pass);
}

INSTANTIATE_TEST_SUITE_P(
    H10, CrashingScript,
    testing::Values(
        "function* g() { yield* g(); }\nfor (const x of g());", "const a = new Array(2e7).fill(1);\nMath.max(...a);",
        "bench.drive(...new Array(3e7));",
        "const m = new WeakMap(); const k = [];\nfor (let i = 0; i < 3e6; ++i) { const o = {}; k.push(o); "
        "m.set(o, o); }\nthrow 'enough';",
        "let p = {};\nfor (let i = 0; i < 1e5; ++i) p = new Proxy(p, {});\nthrow p.x === undefined ? 'no' : p;",
        "const t = 'x'.repeat(2e8);\nthrow new Error(t);", "const t = 'x'.repeat(2e8);\nbench.wait(t);",
        "const a = []; for (let i = 0; i < 2e5; ++i) a.push('(');\nnew RegExp(a.join(''));"));

TEST(HostileScript, TheOutputIsOffWithinTenMillisecondsOfItsEnd) {
    RecordProperty("hazard", "H2");
    std::vector<double> took_ms;
    for (int i = 0; i < 5; ++i) {
        RunBench rig(false);
        const bool waits = i % 2 == 1;  // the script waits in a host call when its process ends
        auto request = rig.request(withRun(kDelivering + (waits ? "bench.wait(3600);" : "for (;;) bench.live();")));
        std::promise<void> armed;
        request.onLog = [&, first = true](const std::string&) mutable {
            if (std::exchange(first, false)) armed.set_value();
        };
        auto run = ScriptRun::start(std::move(request)).value();
        armed.get_future().wait();
        ASSERT_FALSE(rig.outputOff());
        ASSERT_GT(run->processId(), 0);
        const auto begun = steady_clock::now();
        ASSERT_EQ(::kill(run->processId(), SIGSEGV), 0);
        while (!rig.outputOff()) std::this_thread::yield();
        took_ms.push_back(std::chrono::duration<double, std::milli>(steady_clock::now() - begun).count());
        const auto outcome = run->wait();
        ASSERT_TRUE(outcome.error);
        EXPECT_EQ(outcome.error->code, ErrorCode::Io) << "exit code 3";
        EXPECT_THAT(outcome.error->message, HasSubstr("made the script engine crash"));
    }
    std::ranges::sort(took_ms);
#ifdef TACTOSCOPE_SANITIZED
    constexpr double kMax_ms = 40;  // the process is ten times as large, and the system must first end it
#else
    constexpr double kMax_ms = 10;
#endif
    EXPECT_IN_TIME(took_ms[took_ms.size() / 2] < kMax_ms) << testing::PrintToString(took_ms);
}

TEST(HostileScript, ACallThatWouldComputeForLongIsRefused) {
    RecordProperty("hazard", "H2");  // a stop would wait for the script
    for (const char* call :
         {"analysis.transitions({ lines: 101, traverse_s: 600 });",
          "const t = []; for (let i = 0; i < 3e4; ++i) t.push({ condition: 'c' + i % 6000, amplitude: 1, interval_s: 1 "
          "});\nanalysis.separability(t);",
          "const m = []; for (let i = 1; i < 1e5; ++i) m.push(i);\nbench.sensorCalibration.begin({ smooth: 'a', "
          "smooth_ra_um: 1, smooth_rz_um: 0, smooth_file: '', rough: 'b', rough_ra_um: 2, rough_rz_um: 0, rough_file: "
          "'', more: '', weights_g: m.join(';'), weight_repeats: 1000, weight_tolerance_pct: 0, gravity_m_s2: 9.8, "
          "gravity_tolerance_pct: 0, contact_area_cm2: 0, contact_area_tolerance_pct: 0, reference_tolerance_pct: 1, "
          "speed_mm_s: 50, force_n: 1, duration_s: 1, store: false });"}) {
        const auto begun = steady_clock::now();
        const auto left = runToItsEnd(call);
        ASSERT_TRUE(left.outcome.error) << call;
        EXPECT_THAT(left.outcome.error->message, HasSubstr("is expected")) << call;
        EXPECT_LT(left.outcome.error->message.size(), 2100U);
        EXPECT_IN_TIME(steady_clock::now() - begun < std::chrono::seconds(5)) << call;
    }
}

TEST(HostileScript, ItsSentenceIsShortWhateverItHandsOver) {
    RecordProperty("hazard", "H10");
    const auto left = runToItsEnd("bench.fitLoad('1 ohm + '.repeat(2e6));");
    ASSERT_TRUE(left.outcome.error);
    EXPECT_LT(left.outcome.error->message.size(), 2100U);
    EXPECT_TRUE(left.recorded);
}

TEST(HostileScript, AStopEndsItBehindATextOfAnySize) {
    RecordProperty("hazard", "H10");
    RunBench rig(false);
    auto request =
        rig.request(withRun(kDelivering + "const t = 'x'.repeat(2e8); for (;;) { try { throw new Error(t); } "
                                          "catch (e) { try { log(e.message); } catch (f) {} } }"));
    std::promise<void> armed;
    request.onLog = [&, first = true](const std::string&) mutable {
        if (std::exchange(first, false)) armed.set_value();
    };
    auto run = ScriptRun::start(std::move(request)).value();
    armed.get_future().wait();
    std::this_thread::sleep_for(milliseconds(300));
    const auto begun = steady_clock::now();
    run->stop("the test");
    EXPECT_TRUE(rig.outputOff());
    const auto outcome = run->wait();
    EXPECT_IN_TIME(steady_clock::now() - begun < milliseconds(700));
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Stopped);
}

TEST(HostileScript, ItsProcessHoldsNothingOfTheProgram) {
    RecordProperty("hazard", "H10");
    RunBench rig(false);
    auto request = rig.request(withRun("log('here'); for (;;) {}"));
    std::promise<void> here;
    request.onLog = [&](const std::string&) { here.set_value(); };
    auto run = ScriptRun::start(std::move(request)).value();
    here.get_future().wait();
    const std::filesystem::path process = "/proc/" + std::to_string(run->processId());
    std::vector<std::string> held;
    for (const auto& entry : std::filesystem::directory_iterator(process / "fd"))
        held.push_back(std::filesystem::read_symlink(entry.path()).string());
    for (const auto& file : held) {
        EXPECT_THAT(file, testing::AnyOf("/dev/null", testing::StartsWith("socket:"),
                                         testing::StartsWith("anon_inode:"), testing::EndsWith("/statm")));
    }
    EXPECT_EQ(std::ranges::count_if(held, [](const auto& file) { return file.starts_with("socket:"); }), 1);
    std::ifstream status(process / "status");
    const std::string text(std::istreambuf_iterator<char>(status), {});
    EXPECT_THAT(text, testing::AnyOf(HasSubstr("Seccomp:\t2"), testing::Not(HasSubstr("Seccomp:"))));
    for (const auto& task : std::filesystem::directory_iterator(process / "task")) {
        std::ifstream of(task.path() / "status");
        EXPECT_THAT(std::string(std::istreambuf_iterator<char>(of), {}),
                    testing::AnyOf(HasSubstr("Seccomp:\t2"), testing::Not(HasSubstr("Seccomp:"))))
            << task.path();
    }
    run->stop("the test");
    static_cast<void>(run->wait());
    EXPECT_FALSE(std::filesystem::exists(process)) << "nothing is left of it";
}

TEST(HostileScript, AReaderThatWasEndedMeanwhileIsStartedAgain) {
    RecordProperty("hazard", "H10");
    ProtocolSource shipped = probe(withRun(""));
    shipped.shipped = true;  // one process reads all shipped scripts
    ASSERT_TRUE(readDeclaration(shipped));
    std::ifstream children(fmt::format("/proc/self/task/{}/children", ::getpid()));
    if (!children) GTEST_SKIP() << "this system does not list a program's children";
    for (pid_t child = 0; children >> child;) ::kill(child, SIGKILL);
    std::this_thread::sleep_for(milliseconds(50));
    const auto read = readDeclaration(shipped);
    EXPECT_TRUE(read) << read.error().message;
}

TEST(HostileScript, WhatAnotherProgramSaysInItsPlaceIsReadAsALie) {
    RecordProperty("hazard", "H10");
    const int lies = trials<int>({.local = 40, .ci = 140, .campaign = 10'000});
    for (int seed = 0; seed < lies; ++seed) {
        ::setenv("TACTO_LIE", std::to_string(seed).c_str(), 1);
        RunBench rig(true, "sim:", 1, true);
        auto request = rig.request(withRun(""));
        request.program = programBeside("script_liar");
        const auto left = runToItsEnd(rig, std::move(request), milliseconds(1500));
        ASSERT_TRUE(left.off) << seed;
        ASSERT_TRUE(left.recorded) << seed;
        ASSERT_TRUE(left.outcome.error) << seed;
        ASSERT_FALSE(left.outcome.error->message.empty()) << seed;
        ASSERT_LT(left.outcome.error->message.size(), 3000U) << seed;
        ASSERT_NE(left.outcome.verdict, ScriptVerdict::Pass) << seed;
        ASSERT_EQ(left.outcome.error->message.find("by operator"), std::string::npos) << seed;
    }
    ::unsetenv("TACTO_LIE");
}

/// Random combinations of statements that are hard on an engine or on the program.
class Attacker {
public:
    explicit Attacker(std::uint64_t seed) : random_(seed) {}

    std::string script() {
        std::string out;
        const int statements = 1 + pick(4);
        for (int i = 0; i < statements; ++i) out += wrapped(statement(), pick(3)) + "\n";
        return out;
    }

private:
    int pick(int below) { return static_cast<int>(random_() % static_cast<std::uint64_t>(below)); }
    std::string number() {
        static constexpr const char* kNumbers[] = {"0",   "-1",  "NaN",  "1e9",   "Infinity",
                                                   "2e5", "0.1", "1e-9", "2**31", "'7'"};
        return kNumbers[pick(10)];
    }
    std::string value(int depth = 3) {
        switch (pick(depth > 0 ? 12 : 6)) {
            case 0:
                return number();
            case 1:
                return "'x'.repeat(" + std::to_string(1 << pick(22)) + ")";
            case 2:
                return "undefined";
            case 3:
                return "null";
            case 4:
                return "Symbol('s')";
            case 5:
                return "() => { throw 1; }";
            case 6:
                return "[" + value(depth - 1) + "," + value(depth - 1) + "]";
            case 7:
                return "{ load: " + value(depth - 1) + ", roughness: " + value(depth - 1) + " }";
            case 8:
                return "new Proxy({}, { get() { " + wrapped("throw 2;", pick(2)) + " }, ownKeys() { return ['a']; } })";
            case 9:
                return "{ get load() { bench.wait(0.001); return " + value(depth - 1) + "; } }";
            case 10:
                return "new Array(" + std::to_string(1 << pick(24)) + ")";
            default:
                return "(() => { const a = []; a[0] = a; return a; })()";
        }
    }
    std::string statement() {
        static constexpr const char* kCalls[] = {
            "bench.arm",     "bench.drive",           "bench.wait",     "bench.capture",
            "measure.pulse", "analysis.separability", "record.trial",   "log",
            "report.table",  "bench.setReferences",   "random.uniform", "verdict"};
        switch (pick(12)) {
            case 0:
            case 1:
            case 2:
            case 3:
                return std::string(kCalls[pick(12)]) + "(" + value() + (pick(2) == 0 ? ", " + value() : "") + ");";
            case 4:
                return "(function f(n) { return n > 0 ? f(n - 1) + f(n - 1) : " + number() + "; })(" +
                       std::to_string(pick(28)) + ");";
            case 5:
                return "(function f() { return f(); })();";
            case 6:
                return "(function* g() { yield* g(); })().next();";
            case 7:
                return "[3, 1, 2].sort(() => " + value(1) + ");";
            case 8:
                return "/(a+)+$/.test('" + std::string(static_cast<std::size_t>(10 + pick(30)), 'a') + "b');";
            case 9:
                return "JSON.stringify(" + value() + ");";
            case 10:
                return "new Map([[" + value() + ", 1]]);";
            default:
                return "for (let i = 0; i < " + std::to_string(1 << pick(20)) + "; ++i) { " +
                       (pick(3) == 0 ? "bench.live();" : "i.toString();") + " }";
        }
    }
    std::string wrapped(const std::string& body, int how) {
        if (how == 1) return "try { " + body + " } catch (e) {}";
        if (how == 2)
            return "try { " + body + " } catch (e) { log(String(e.message).length); } finally { bench.live(); }";
        return body;
    }

    std::mt19937_64 random_;
};

TEST(HostileScript, WhateverItSaysTheOutputIsOffAndTheSessionWhole) {
    RecordProperty("hazard", "H10");
    const int scripts = trials<int>({.local = 60, .ci = 200, .campaign = 10'000});
    int ended = 0, lost = 0;
    for (int seed = 0; seed < scripts; ++seed) {
        const auto body = Attacker(static_cast<std::uint64_t>(seed)).script();
        SCOPED_TRACE(fmt::format("seed {}: {}", seed, body));
        RunBench rig(true, "sim:", 1, true);
        auto request = rig.request(withRun(kDelivering + body));
        request.memoryLimit = std::size_t{300} << 20;
        const auto left = runToItsEnd(rig, std::move(request), milliseconds(500));
        ASSERT_TRUE(left.off);
        ASSERT_TRUE(left.recorded);
        ASSERT_TRUE(!left.outcome.error || !left.outcome.error->message.empty());
        ended += left.outcome.error ? 1 : 0;
        lost += left.outcome.error && left.outcome.error->code == ErrorCode::Io ? 1 : 0;
    }
    EXPECT_GT(ended, scripts / 4) << "attacks that the program does not notice test nothing";
    RecordProperty("engines lost", lost);
}

}  // namespace
}  // namespace tacto::test
