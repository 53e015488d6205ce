// Stops by the operator, crashes, and scripts that fail or do not end.
#include <csignal>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "core/base/Result.h"
#include "tests/cli/ExitsInTime.h"
#include "tests/cli/Shape.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begun) { return std::chrono::duration<double>(Clock::now() - begun).count(); }

void expectStopped(const Desk& desk, const Ran& ran) {
    ASSERT_EXIT_IN_TIME(ran.code, 4) << ran.err;
    const auto value = jsonOf(ran);
    EXPECT_EQ(value["verdict"], "stopped");
    EXPECT_TRUE(value["results"].is_null());
    EXPECT_THAT(ran.err, HasSubstr("stopped by operator"));
    EXPECT_EQ(desk.run({"verify", value["session"]}).code, 0) << "what was recorded before the stop is whole";
    EXPECT_TRUE(std::filesystem::exists(value["report"].get<std::string>()));
}

class Stop : public testing::Test {
protected:
    /// Starts a run that would take half a minute; its session has already begun.
    Desk::Started live() const {
        return desk.start({"run", "live", "--device", "sim:", "--realtime", "--out", desk.at("out"), "--json"});
    }
    [[nodiscard]] bool sessionBegun() const { return !desk.named("out", ".tacto").empty(); }
    const Desk desk;
};

TEST_F(Stop, AnInterruptEndsALiveRunWithExitCodeFour) {
    RecordProperty("hazard", "H2");
    auto run = live();
    ASSERT_IN_TIME(run.waitUntil([&] { return sessionBegun(); }));
    const auto begun = Clock::now();
    ASSERT_IN_TIME(run.waitUntil([&] { return secondsSince(begun) > 1; }));
    run.signal(SIGINT);
    const auto signalled = Clock::now();
    expectStopped(desk, run.wait(std::chrono::seconds(20)));
    EXPECT_IN_TIME(secondsSince(signalled) < 5);
}

TEST_F(Stop, ATerminationATerminalThatClosesAndAQuitDoTheSame) {
    RecordProperty("hazard", "H2");
    for (const int signal : {SIGTERM, SIGHUP, SIGQUIT}) {
        std::filesystem::remove_all(desk.at("out"));
        auto run = live();
        ASSERT_IN_TIME(run.waitUntil([&] { return sessionBegun(); }));
        run.signal(signal);
        expectStopped(desk, run.wait(std::chrono::seconds(20)));
    }
}

TEST_F(Stop, AnInterruptAtAnyMomentOfTheStartEndsTheRunInOrder) {
    RecordProperty("hazard", "H2");
    for (int delay = 0; delay < 120; delay += 8) {
        std::filesystem::remove_all(desk.at("out"));
        auto run = live();
        ASSERT_IN_TIME(run.waitUntil([&] { return sessionBegun(); }));
        const auto begun = Clock::now();
        ASSERT_IN_TIME(run.waitUntil([&] { return secondsSince(begun) * 1000 >= delay; }));
        run.signal(SIGINT);
        const auto ran = run.wait(std::chrono::seconds(20));
        ASSERT_EXIT_IN_TIME(ran.code, 4) << delay << " ms after the session began: " << ran.err;
    }
}

TEST_F(Stop, ASignalWhileTheReportsAreDrawnEndsTheProgramAndTheSessionIsComplete) {
    RecordProperty("hazard", "H8");
    const auto script = desk.protocol("long.js", R"js(protocol({ title: "Long report" });
function run(p) {
  const rows = [];
  for (let i = 0; i < 4000; i++) rows.push({ a: i, b: "x".repeat(900) });
  report.table("Rows", rows);
  return verdict({ verdict: "pass" });
})js");
    auto run = desk.start({"run", script, "--device", "sim:", "--out", desk.at("out")});
    ASSERT_IN_TIME(run.waitUntil([&] { return !desk.named("out", ".html").empty(); })) << "the first report";
    run.signal(SIGINT);
    const auto signalled = Clock::now();
    const auto ran = run.wait(std::chrono::seconds(60));
    EXPECT_IN_TIME(secondsSince(signalled) < 2);
    ASSERT_EXIT_IN_TIME(ran.code, 4);
    EXPECT_THAT(ran.err, HasSubstr("before the reports were written"));
    EXPECT_TRUE(desk.named("out", ".pdf").empty());
    EXPECT_EQ(desk.run({"verify", desk.named("out", ".tacto").at(0)}).code, 0);
}

TEST_F(Stop, ARunWhoseSessionIsGoneHasNoVerdictAndDoesNotSucceed) {
    RecordProperty("hazard", "H8");
    auto run = desk.start(
        {"run", "live", "--device", "sim:", "--realtime", "--set", "duration=2", "--out", desk.at("out"), "--json"});
    // Open, not only created.
    ASSERT_IN_TIME(run.waitUntil([&] { return sessionBegun() && !desk.named("out", ".tacto-wal").empty(); }));
    std::filesystem::remove(desk.named("out", ".tacto").at(0));
    const auto ran = run.wait(std::chrono::seconds(60));
    EXPECT_EQ(ran.code, 3) << ran.err;
    const auto value = jsonOf(ran);
    EXPECT_TRUE(value["verdict"].is_null());
    EXPECT_TRUE(value["error"].is_string());
}

TEST_F(Stop, WhatCannotBePrintedIsNoSuccess) {
    const auto ran = desk.run({"encode", "--roughness", "1", "--pressure-pa", "60000", "--load", "1000", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const std::string full =
        std::string(TACTO_CLI) + " encode --roughness 1 --pressure-pa 60000 --load 1000 --json >/dev/full 2>/dev/null";
    EXPECT_EQ(WEXITSTATUS(std::system(full.c_str())), 3);
}

TEST_F(Stop, AKilledRunLeavesASessionThatIsIntactAndSaysThatItWasRecovered) {
    RecordProperty("hazard", "H8");
    auto run = live();
    ASSERT_IN_TIME(run.waitUntil([&] { return sessionBegun(); }));
    const auto begun = Clock::now();
    ASSERT_IN_TIME(run.waitUntil([&] { return secondsSince(begun) > 4; }));  // a slow disk takes a second per commit
    run.signal(SIGKILL);
    EXPECT_EQ(run.wait().code, -SIGKILL);
    const auto session = desk.named("out", ".tacto").at(0);
    const auto verified = desk.run({"verify", session, "--json"});
    EXPECT_EQ(verified.code, 0) << verified.out;
    EXPECT_EQ(jsonOf(verified)["recovered"], true);
    EXPECT_IN_TIME(jsonOf(verified)["samples"].get<int>() >= 12'000) << "4 s at 4 kHz, all but the last second";
    EXPECT_THAT(desk.run({"verify", session}).out, HasSubstr("recovered"));
}

/// Runs a script of the user.
class UserScript : public Stop {
protected:
    std::string script(const std::string& body, const std::string& needs = "[\"stimulator\"]") const {
        return desk.protocol("mine.js", "protocol({\n  title: \"Mine\",\n  purpose: \"A test.\",\n  needs: " + needs +
                                            ",\n  parameters: {},\n});\n\nfunction run(p) {\n" + body + "\n}\n");
    }
    Words words() const { return {"run", "mine", "--device", "sim:", "--out", desk.at("out"), "--json"}; }
};

TEST_F(UserScript, AnEndlessLoopIsStoppedWithinAFewSeconds) {
    RecordProperty("hazard", "H10");
    const auto path = script("  for (;;) { }");
    auto run = desk.start(words());
    ASSERT_IN_TIME(run.waitUntil([&] { return sessionBegun(); }));
    const auto begun = Clock::now();
    ASSERT_IN_TIME(run.waitUntil([&] { return secondsSince(begun) > 1; }));  // by now the script has begun too
    run.signal(SIGINT);
    const auto signalled = Clock::now();
    const auto ran = run.wait(std::chrono::seconds(20));
    EXPECT_IN_TIME(secondsSince(signalled) < 5);
    expectStopped(desk, ran);
    EXPECT_THAT(ran.err, HasSubstr(path + ":"));
}

TEST_F(UserScript, ALoopThatCatchesEverythingIsStoppedToo) {
    RecordProperty("hazard", "H10");
    script("  for (;;) { try { bench.wait(1); } catch (anything) { } }");
    auto command = words();
    command.push_back("--realtime");
    auto run = desk.start(command);
    ASSERT_IN_TIME(run.waitUntil([&] { return sessionBegun(); }));
    run.signal(SIGINT);
    const auto signalled = Clock::now();
    expectStopped(desk, run.wait(std::chrono::seconds(20)));
    EXPECT_IN_TIME(secondsSince(signalled) < 5);
}

TEST_F(UserScript, AnErrorNamesFileLineAndReason) {
    const auto path = script("  const nothing = undefined;\n  return nothing.at;");
    const auto ran = desk.run(words());
    EXPECT_EQ(ran.code, 3);
    EXPECT_THAT(ran.err, HasSubstr(path + ":10: TypeError"));
    const auto value = jsonOf(ran);
    EXPECT_TRUE(value["verdict"].is_null());
    EXPECT_TRUE(value["results"].is_null());
}

TEST_F(UserScript, ThrownTextIsNamedAsAnErrorIs) {
    const auto path = script("  if (true) {\n    throw \"the wires are loose\";\n  }");
    const auto ran = desk.run(words());
    EXPECT_EQ(ran.code, 3);
    EXPECT_THAT(ran.err, HasSubstr(path + ":10: the wires are loose"));
}

TEST_F(UserScript, AQuestionWithoutAnAnswerNamesTheMissingSetting) {
    script("  operator.confirm(\"wiring\", \"Check the wiring\");");
    const auto ran = desk.run(words());
    EXPECT_NE(ran.code, 0);
    EXPECT_THAT(ran.err, HasSubstr("wiring"));
    auto answered = words();
    answered.insert(answered.end(), {"--set", "wiring=yes"});
    EXPECT_EQ(desk.run(answered).code, 0);
}

TEST_F(UserScript, ADeviceThatTheCommandLineDoesNotNameIsAskedFor) {
    script("", "[\"oscilloscope\"]");
    expectRefused(desk.run({"run", "mine", "--out", desk.at("out"), "--json"}), 3, {"oscilloscope", "sim:"});
    EXPECT_FALSE(sessionBegun());
}

}  // namespace
}  // namespace tacto::test
