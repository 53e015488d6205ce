// A missed deadline is told apart from every other failure: only it is tried again, and only where the machine stood
// still.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"

namespace tacto::test {

TEST(InTime, AMissedDeadlineBeginsItsMessageByThatAndNoOtherFailureDoes) {
    testing::TestPartResultArray failures;
    {
        const testing::ScopedFakeTestPartResultReporter catching(&failures);
        EXPECT_IN_TIME(1 > 2) << "after two seconds";
        EXPECT_TRUE(1 > 2);
        EXPECT_IN_TIME(2 > 1);
    }
    ASSERT_EQ(failures.size(), 2);
    EXPECT_EQ(std::string_view(failures.GetTestPartResult(0).message()).find(kNotInTime), 0U);
    EXPECT_NE(std::string_view(failures.GetTestPartResult(0).message()).find("after two seconds"), std::string::npos);
    EXPECT_NE(std::string_view(failures.GetTestPartResult(1).message()).find(kNotInTime), 0U);
}

TEST(InTime, OfWrongErrorsOnlyThoseThatComeOfBeingLateAreMissedDeadlines) {
    testing::TestPartResultArray failures;
    {
        const testing::ScopedFakeTestPartResultReporter catching(&failures);
        EXPECT_CODE_IN_TIME(ErrorCode::Device, ErrorCode::Device);
        EXPECT_CODE_IN_TIME(ErrorCode::Timeout, ErrorCode::Device);
        EXPECT_CODE_IN_TIME(ErrorCode::NotArmed, ErrorCode::Device);
        EXPECT_CODE_IN_TIME(ErrorCode::Stopped, ErrorCode::Device);
        EXPECT_CODE_IN_TIME(ErrorCode::Io, ErrorCode::Device);
        EXPECT_CODE_IN_TIME(ErrorCode::LimitExceeded, ErrorCode::Stopped);
    }
    ASSERT_EQ(failures.size(), 5);
    for (int i = 0; i < 5; ++i) {
        const std::string_view message(failures.GetTestPartResult(i).message());
        EXPECT_EQ(message.starts_with(kNotInTime), i < 3) << message;
    }
}

TEST(InTime, OnlyAnErrorThatLatenessCausesIsAMissedDeadline) {
    testing::TestPartResultArray failures;
    {
        const testing::ScopedFakeTestPartResultReporter catching(&failures);
        for (const auto code : {ErrorCode::Timeout, ErrorCode::NotArmed, ErrorCode::Stopped, ErrorCode::Device,
                                ErrorCode::LimitExceeded, ErrorCode::InvalidArgument, ErrorCode::ParseError,
                                ErrorCode::NotFound, ErrorCode::Io, ErrorCode::Unsupported}) {
            const Result<void> failed = fail(code, "the reason");
            EXPECT_IN_TIME(failed);
        }
    }
    ASSERT_EQ(failures.size(), 10) << "one for each error code";
    for (int i = 0; i < 10; ++i) {
        const std::string_view message(failures.GetTestPartResult(i).message());
        EXPECT_EQ(message.starts_with(kNotInTime), i < 3) << message;
        EXPECT_NE(message.find("the reason"), std::string_view::npos) << message;
    }
}

/// Tests that fail at their first try. They are disabled for ctest; the last test of this file runs each of them in a
/// process of its own.
class InTimeExample : public testing::Test {
protected:
    static bool first() { return std::getenv("TACTO_TEST_TRY") == nullptr; }
    /// What a machine does that has no time for this process.
    static void standStill() {
        const pid_t process = ::getpid();
        const pid_t waker = ::fork();
        ASSERT_GE(waker, 0);
        if (waker == 0) {  // system calls only: this process has threads
            ::usleep(60'000);
            ::kill(process, SIGCONT);
            ::_exit(0);
        }
        ::kill(process, SIGSTOP);
        ASSERT_EQ(::waitpid(waker, nullptr, 0), waker);
    }
    static void arm() { ASSERT_IN_TIME(!first()); }
};

TEST_F(InTimeExample, DISABLED_ADeadline) {
    standStill();
    EXPECT_IN_TIME(!first());
}

TEST_F(InTimeExample, DISABLED_ADeadlineWithinAFunction) {
    standStill();
    arm();
    EXPECT_FALSE(first()) << "a bench that is not armed does not deliver";
}

TEST_F(InTimeExample, DISABLED_AnInvariant) {
    standStill();
    EXPECT_IN_TIME(!first());
    EXPECT_FALSE(first()) << "a train after a stop";
}

int exitCodeOf(const std::string& example) {
    const auto program = std::filesystem::read_symlink("/proc/self/exe").string();
    const auto command = "env -u TACTO_TEST_TRY -u TACTO_RETRIES " + program +
                         " --gtest_also_run_disabled_tests --gtest_filter=InTimeExample.DISABLED_" + example +
                         " >/dev/null 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(InTime, OfATestThatFailedWhileTheMachineStoodStillOnlyDeadlinesAreTriedAgain) {
    EXPECT_EQ(exitCodeOf("ADeadline"), 0);
    EXPECT_EQ(exitCodeOf("ADeadlineWithinAFunction"), 0) << "what comes after it in the test has no say";
    EXPECT_EQ(exitCodeOf("AnInvariant"), 1) << "it failed once: that is final";
}

}  // namespace tacto::test
