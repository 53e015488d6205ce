// sciencemode pulse at a terminal: the second of two steps is a typed word; before it nothing is delivered.
#include <chrono>
#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

#include "tests/cli/ExitsInTime.h"
#include "tests/cli/TerminalCli.h"
#include "tests/support/InTime.h"
#include "tests/support/emulated/sciencemode/EmulatedPty.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class ScienceModeConfirm : public testing::Test {
protected:
    ScienceModeConfirm() { RecordProperty("hazard", "H12"); }
    [[nodiscard]] Words words() const {
        return {"sciencemode", "pulse", "--current", "5",
                "--width",     "200",   "--gap",     "100",
                "--load",      "1000",  "--device",  "sciencemode:?emulated=yes&tty=" + pty_->path()};
    }
    [[nodiscard]] std::size_t putOut() const {
        return pty_->inspect([](auto& device, Instant now) { return device.pulses(now).size(); });
    }
    void expectUnconfirmed(TerminalCli& cli) const {
        const int code = cli.wait();
        EXPECT_NE(code, 0) << cli.screen();
        EXPECT_EQ(putOut(), 0U) << cli.screen();
        ASSERT_EXIT_IN_TIME(code, 4) << cli.screen();
    }
    static constexpr const char* kQuestion = "anything else delivers nothing: ";

    const SteadyClock clock_;
    const Desk desk_;
    const std::unique_ptr<sciencemode::EmulatedPty> pty_ = *sciencemode::EmulatedPty::open({}, clock_);
};

TEST_F(ScienceModeConfirm, TheTypedWordDelivers) {
    TerminalCli cli(desk_, words());
    ASSERT_IN_TIME(cli.waitFor(kQuestion)) << cli.screen();
    EXPECT_THAT(cli.screen(), HasSubstr("EMU0000001 (simulated)"));
    EXPECT_THAT(cli.screen(), HasSubstr("5 mA, 200 us a phase, 100 us between"));
    EXPECT_THAT(cli.screen(), HasSubstr("bench load of 1 kohm"));
    EXPECT_EQ(putOut(), 0U) << "before it was confirmed";
    cli.type("bench load\n");
    ASSERT_IN_TIME(cli.wait() == 0) << cli.screen();
    EXPECT_EQ(putOut(), 2U);
    EXPECT_THAT(cli.screen(), HasSubstr("verdict  pass"));
}

class ScienceModeUnconfirmed : public ScienceModeConfirm, public testing::WithParamInterface<const char*> {};

TEST_P(ScienceModeUnconfirmed, AnythingElseDeliversNothing) {
    TerminalCli cli(desk_, words());
    ASSERT_IN_TIME(cli.waitFor(kQuestion)) << cli.screen();
    cli.type(GetParam());
    expectUnconfirmed(cli);
    EXPECT_THAT(cli.screen(), HasSubstr("not confirmed: nothing was delivered"));
}

INSTANTIATE_TEST_SUITE_P(Typed, ScienceModeUnconfirmed,
                         testing::Values("\n", "y\n", "yes\n", "bench\n", "bench loads\n", "Bench load\n", "\x04"));

TEST_F(ScienceModeConfirm, WhatWasTypedBeforeTheQuestionIsNoAnswer) {
    TerminalCli cli(desk_, words());
    cli.type("bench load\n");
    ASSERT_IN_TIME(cli.waitFor(kQuestion)) << cli.screen();
    cli.type("no\n");
    expectUnconfirmed(cli);
    EXPECT_EQ(putOut(), 0U);
}

/// On a busy machine the kernel delivers typed text up to 100 ms late.
TEST_F(ScienceModeConfirm, WhatIsTypedJustBeforeTheQuestionIsNoAnswerThoughItArrivesLate) {
    TerminalCli cli(desk_, words());
    const auto identified = [this] {
        return pty_->inspect([](auto& device, Instant) { return device.requests(sciencemode::Command::DeviceId); });
    };
    while (identified() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    cli.type("bench load\n");
    ASSERT_IN_TIME(cli.waitFor(kQuestion)) << cli.screen();
    ASSERT_IN_TIME(cli.screen().starts_with("bench load")) << cli.screen();
    cli.type("no\n");
    expectUnconfirmed(cli);
}

TEST_F(ScienceModeConfirm, CtrlCWhileItWaitsDeliversNothing) {
    RecordProperty("hazard", "H2");
    TerminalCli cli(desk_, words());
    ASSERT_IN_TIME(cli.waitFor(kQuestion)) << cli.screen();
    cli.type("bench load\x03");
    expectUnconfirmed(cli);
    EXPECT_THAT(cli.screen(), HasSubstr("stopped by the operator"));
    EXPECT_EQ(putOut(), 0U);
    EXPECT_GE(pty_->inspect([](auto& device, Instant) { return device.requests(sciencemode::Command::LowLevelStop); }),
              2U)
        << "the output was not switched off on the way out";
}

TEST_F(ScienceModeConfirm, ADrawingIsAsWideAsItsTerminal) {
    TerminalCli cli(desk_, words(), 50);
    ASSERT_IN_TIME(cli.waitFor(kQuestion)) << cli.screen();
    cli.type("bench load\n");
    ASSERT_IN_TIME(cli.wait() == 0) << cli.screen();
    const auto axis = cli.screen().find("+---");
    ASSERT_NE(axis, std::string::npos);
    const auto begin = cli.screen().rfind('\n', axis) + 1;
    EXPECT_EQ(cli.screen().find('\n', axis) - begin, 50U);
}

}  // namespace
}  // namespace tacto::test
