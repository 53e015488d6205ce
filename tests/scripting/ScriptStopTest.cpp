// Stop works whatever the script does (hazards H2 and H10).
#include <condition_variable>
#include <future>
#include <gtest/gtest.h>
#include <mutex>

#include "tests/scripting/RunBench.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"

namespace tacto {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using test::RunBench;
using test::withRun;

const std::string kArmed =
    "bench.arm({ load: 1000 }); bench.drive('manual', { roughness: 1, pressure: 1 }); bench.wait(0.6); log('here');\n";

/// The longest time from stop() to the report: the script's process is ended at once, whatever it does.
constexpr milliseconds kReported{700};

/// Waits for an operator who never answers.
class EmptyDesk final : public Operator {
public:
    Result<nlohmann::json> ask(const OperatorQuestion&) override {
        std::unique_lock lock(mutex_);
        asked_.notify_all();
        waiting_ = true;
        changed_.wait(lock, [this] { return cancelled_; });
        return fail(ErrorCode::Stopped, "cancelled");
    }
    void cancel() noexcept override {
        const std::lock_guard lock(mutex_);
        cancelled_ = true;
        changed_.notify_all();
    }
    void awaitQuestion() {
        std::unique_lock lock(mutex_);
        asked_.wait(lock, [this] { return waiting_; });
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_, asked_;
    bool waiting_ = false, cancelled_ = false;
};

/// Waits for the script to say something. Returns false if the script ended without saying it.
bool isSaid(std::future<void> said, ScriptRun& run) {
    while (said.wait_for(milliseconds(10)) != std::future_status::ready) {
        if (run.waitFor(milliseconds(0))) return said.wait_for(milliseconds(0)) == std::future_status::ready;
    }
    return true;
}

/// Runs a script up to its first log() line, then stops it.
struct Stopping {
    explicit Stopping(RunBench& rig, const std::string& body) {
        auto request = rig.request(withRun(kArmed + body));
        std::promise<void> reached;
        request.onLog = [&](const std::string&) { reached.set_value(); };
        auto run = ScriptRun::start(std::move(request)).value();
        [&] { ASSERT_IN_TIME(isSaid(reached.get_future(), *run)) << "the script ended before it was armed"; }();
        armedBefore = !rig.outputOff();
        // Long enough for the script to reach its next statement.
        [&] { ASSERT_IN_TIME(!run->waitFor(milliseconds(150))) << "the script ended by itself"; }();
        const auto begin = steady_clock::now();
        run->stop("the test");
        offAtOnce = rig.outputOff();
        outcome = run->wait();
        took = steady_clock::now() - begin;
        offAfter = rig.outputOff();
    }
    bool armedBefore = false, offAtOnce = false, offAfter = false;
    ScriptOutcome outcome;
    steady_clock::duration took{};
};

void expectStopped(const Stopping& stopping, int line) {
    ASSERT_IN_TIME(stopping.armedBefore);
    EXPECT_TRUE(stopping.offAtOnce);
    EXPECT_TRUE(stopping.offAfter);
    EXPECT_EQ(stopping.outcome.verdict, ScriptVerdict::Stopped);
    ASSERT_TRUE(stopping.outcome.error);
    EXPECT_EQ(stopping.outcome.error->code, ErrorCode::Stopped);
    EXPECT_TRUE(stopping.outcome.error->message.starts_with(fmt::format("/lab/probe.js:{}: stopped by the test", line)))
        << stopping.outcome.error->message;
}

TEST(ScriptStop, AScriptThatDrivesAndWaitsNoMoreEndsItsOutput) {
    testing::Test::RecordProperty("hazard", "H2");  // the script computes, or the reader of its output has stopped
    RunBench rig(false);
    const auto begun = steady_clock::now();
    const auto outcome = rig.run(withRun(kArmed + "const until = Date.now() + 4000; while (Date.now() < until);\n"
                                                  "log(bench.live().state); bench.wait(0.1);"));
    ASSERT_TRUE(outcome.error);
    // If the machine stands still, the loop's own checks report a fault first; other tests cover them.
    const auto fault = rig.bench().telemetry().fault;
    ASSERT_IN_TIME(fault != FaultCause::LoopSilent && fault != FaultCause::StatusMissing) << outcome.error->message;
    ASSERT_CODE_IN_TIME(outcome.error->code, ErrorCode::Stopped) << outcome.error->message;
    EXPECT_NE(outcome.error->message.find("did not look after it"), std::string::npos) << outcome.error->message;
    ASSERT_EQ(outcome.log.size(), 2U);
    EXPECT_EQ(outcome.log[1], "disarmed");
    const double seconds = std::chrono::duration<double>(steady_clock::now() - begun).count();
    const double most = 4 / rig.bench().profile().encoding.intervalMin.count();  // one train each 0.5 s for 4 s
    EXPECT_LT(static_cast<double>(rig.bench().telemetry().trainsDelivered), most) << "in " << seconds << " s";
}

TEST(ScriptStop, EndsAnEndlessLoop) {
    RecordProperty("hazard", "H10");
    RunBench rig;
    const Stopping stopping(rig, "for (;;) {}");
    expectStopped(stopping, 2);
    EXPECT_IN_TIME(stopping.took < kReported);
}

TEST(ScriptStop, EndsALoopThatCatchesEverything) {
    RecordProperty("hazard", "H10");
    RunBench rig;
    const Stopping stopping(rig,
                            "for (;;) {\n try { for (;;) bench.wait(0.001); }\n catch (e) { continue; } finally { } }");
    EXPECT_EQ(stopping.outcome.verdict, ScriptVerdict::Stopped);
    EXPECT_TRUE(stopping.offAtOnce);
    EXPECT_TRUE(stopping.offAfter);
}

TEST(ScriptStop, EndsALoopInCompiledFunctions) {
    RecordProperty("hazard", "H10");
    RunBench rig;
    const Stopping stopping(rig,
                            "const f = (n) => { let s = 0; while (n-- !== 0) s += n; return s; };\n"
                            "for (let i = 0; i < 1000; ++i) f(10);\nf(-1);");
    EXPECT_EQ(stopping.outcome.verdict, ScriptVerdict::Stopped);
}

TEST(ScriptStop, WakesABlockedHostCall) {
    RecordProperty("hazard", "H10");
    RunBench rig(false);
    const Stopping stopping(rig, "\nbench.wait(3600);");
    expectStopped(stopping, 4);
    EXPECT_IN_TIME(stopping.took < kReported);
}

TEST(ScriptStop, WakesAQuestionThatTheOperatorDoesNotAnswer) {
    RecordProperty("hazard", "H10");
    RunBench rig;
    EmptyDesk desk;
    auto request = rig.request(withRun("operator.confirm('x', 'Well?');"));
    request.operatorDesk = &desk;
    auto run = ScriptRun::start(std::move(request)).value();
    desk.awaitQuestion();
    run->stop("the test");
    const auto outcome = run->wait();
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Stopped);
    EXPECT_EQ(outcome.line, 2);
}

TEST(ScriptStop, EndsALongNativeCallAtOnce) {
    RecordProperty("hazard", "H10");
    RunBench rig;
    auto request = rig.request(withRun("const a = []; for (let i = 0; i < 1e6; ++i) a[i] = i * 7919 % 1000003;\n" +
                                       kArmed + "a.sort();\nbench.arm({ load: 1000 }); log('alive');"));
    std::promise<void> reached;
    request.onLog = [&](const std::string&) { reached.set_value(); };
    auto run = ScriptRun::start(std::move(request)).value();
    ASSERT_IN_TIME(isSaid(reached.get_future(), *run));
    EXPECT_FALSE(run->waitFor(milliseconds(150)));
    const auto begin = steady_clock::now();
    run->stop("the test");
    EXPECT_TRUE(rig.outputOff());
    const auto outcome = run->wait();
    const auto took = steady_clock::now() - begin;
    EXPECT_IN_TIME(took < kReported);
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Stopped);
    EXPECT_TRUE(outcome.error->message.starts_with("/lab/probe.js:3: stopped by the test")) << outcome.error->message;
    EXPECT_EQ(outcome.error->message.rfind("probe.js"), outcome.error->message.find("probe.js")) << "its path once";
    EXPECT_TRUE(rig.outputOff());
}

TEST(ScriptStop, EndsRecursiveTryFinally) {
    RecordProperty("hazard", "H10");
    RunBench rig;
    const Stopping stopping(rig, "function f() { try { f(); } finally { f(); } }\nf();");
    expectStopped(stopping, 2);
    EXPECT_IN_TIME(stopping.took < kReported);
}

TEST(ScriptStop, AStoppedScriptReachesTheBenchNoMore) {
    RecordProperty("hazard", "H10");
    auto rig = std::make_unique<RunBench>();
    std::atomic<int> logged{0};
    // The sort keeps calling the host function even when the interpreter no longer runs statements.
    auto request = rig->request(
        withRun("const a = []; for (let i = 0; i < 1e6; ++i) a[i] = i * 7919 % 1000003;\n" + kArmed + "a.sort(log);"));
    request.onLog = [&](const std::string&) { ++logged; };
    auto run = ScriptRun::start(std::move(request)).value();
    while (logged < 100) std::this_thread::yield();
    run->stop("the test");
    const auto outcome = run->wait();
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Stopped);
    const int before = logged;
    EXPECT_TRUE(rig->outputOff());
    run.reset();
    rig.reset();  // destroys the bench
    const auto until = steady_clock::now() + milliseconds(200);
    while (steady_clock::now() < until) std::this_thread::yield();
    EXPECT_EQ(logged, before);
}

TEST(ScriptStop, IsTheReasonWhateverTheScriptThrowsAfterwards) {
    RecordProperty("hazard", "H10");
    RunBench rig(false);
    const Stopping stopping(rig, "try { bench.wait(3600); } catch (e) {\n throw 'cleaning up failed'; }");
    EXPECT_EQ(stopping.outcome.verdict, ScriptVerdict::Stopped);
    ASSERT_TRUE(stopping.outcome.error);
    EXPECT_TRUE(stopping.outcome.error->message.starts_with("/lab/probe.js:3: stopped by the test"))
        << stopping.outcome.error->message;
}

TEST(ScriptStop, OfTheBenchByAnotherDoorEndsTheRunToo) {
    RunBench rig(false);
    auto request = rig.request(withRun(kArmed + "bench.wait(3600);"));
    std::promise<void> reached;
    request.onLog = [&](const std::string&) { reached.set_value(); };
    auto run = ScriptRun::start(std::move(request)).value();
    ASSERT_IN_TIME(isSaid(reached.get_future(), *run));
    rig.bench().stop("the red button");
    const auto outcome = run->wait();
    ASSERT_IN_TIME(outcome.verdict == ScriptVerdict::Stopped);
    ASSERT_TRUE(outcome.error);
    EXPECT_TRUE(outcome.error->message.starts_with("/lab/probe.js:3: ")) << outcome.error->message;
    EXPECT_TRUE(rig.outputOff());
}

TEST(ScriptStop, PauseHoldsTheScriptAndResumeLetsItGo) {
    RunBench rig;
    std::atomic<int> steps{0};
    std::promise<void> begun;
    auto request = rig.request(withRun("for (let i = 0; i < 2000; ++i) { bench.wait(0.001); log(i); }"));
    request.onLog = [&](const std::string&) {
        if (++steps == 1) begun.set_value();
    };
    auto run = ScriptRun::start(std::move(request)).value();
    ASSERT_IN_TIME(isSaid(begun.get_future(), *run));
    run->pause();
    (void)run->waitFor(milliseconds(50));  // what was running before the pause has ended
    const int held = steps;
    EXPECT_FALSE(run->waitFor(milliseconds(100)));
    EXPECT_EQ(steps, held);
    EXPECT_LT(held, 2000);
    run->resume();
    const auto outcome = run->wait();
    EXPECT_FALSE(outcome.error);
    EXPECT_EQ(steps, 2000);
}

TEST(ScriptStop, EndsAPausedScript) {
    RunBench rig;
    auto request = rig.request(withRun("log('begin'); for (;;) bench.wait(0.001);"));
    std::promise<void> begun;
    request.onLog = [&](const std::string&) { begun.set_value(); };
    auto run = ScriptRun::start(std::move(request)).value();
    ASSERT_IN_TIME(isSaid(begun.get_future(), *run));
    run->pause();
    EXPECT_FALSE(run->waitFor(milliseconds(50)));
    run->stop("the test");
    const auto outcome = run->wait();
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Stopped);
}

TEST(ScriptStop, BeforeTheStartIsNotForgotten) {
    RecordProperty("hazard", "H2");
    RunBench rig;
    auto request = rig.request(withRun("bench.arm({ load: 1000 });"));
    rig.bench().stop("the operator");
    const auto started = ScriptRun::start(request);
    ASSERT_FALSE(started);
    EXPECT_EQ(started.error().code, ErrorCode::Stopped) << started.error().message;
    EXPECT_TRUE(rig.outputOff());
    request.asked = {};
    EXPECT_FALSE(ScriptRun::start(request)) << "a run whose mark was forgotten starts nothing";
    request.asked = rig.bench().stops().mark();
    const auto outcome = runProtocol(std::move(request)).value();
    EXPECT_FALSE(outcome.error) << "asked for after the stop: " << outcome.error->message;
}

TEST(ScriptStop, AfterTheEndLeavesTheBenchAlone) {
    RunBench rig;
    auto run = ScriptRun::start(rig.request(withRun("return verdict({ verdict: 'pass' });"))).value();
    EXPECT_EQ(run->wait().verdict, ScriptVerdict::Pass);
    run->stop("too late");
    EXPECT_EQ(run->wait().verdict, ScriptVerdict::Pass);
    EXPECT_TRUE(rig.bench().arm({"1 kohm", true, true}));  // a stopped bench would refuse
}

}  // namespace
}  // namespace tacto
