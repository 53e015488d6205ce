// A missed deadline differs from all other failures: only a missed deadline is tried again, and only if the machine was
// too busy.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <mutex>
#include <poll.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "core/base/Clock.h"
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

/// Stops this process for a while, like a machine that has no time for it.
void standStill() {
    const pid_t process = ::getpid();
    const pid_t waker = ::fork();
    ASSERT_GE(waker, 0);
    if (waker == 0) {  // only system calls are safe: this process has threads
        ::usleep(60'000);
        ::kill(process, SIGCONT);
        ::_exit(0);
    }
    ::kill(process, SIGSTOP);
    ASSERT_EQ(::waitpid(waker, nullptr, 0), waker);
}

/// Tests that fail at their first try. They are disabled for ctest; the last test of this file runs each of them in its
/// own process.
class InTimeExample : public testing::Test {
protected:
    static bool first() { return std::getenv("TACTO_TEST_TRY") == nullptr; }
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

#ifndef TACTOSCOPE_SANITIZED  // sanitized programs lack PatientClock.cpp
double machine_ms() {
    std::timespec at{};
    ::syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &at);
    return 1e3 * static_cast<double>(at.tv_sec) + 1e-6 * static_cast<double>(at.tv_nsec);
}
double own_ms() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TEST(PatientClock, StandsStillWithTheMachineAndSoDoDeadlines) {
    const SteadyClock clock;
    std::atomic<double> polled_ms{0}, waited_ms{0}, slept_ms{0};
    const auto inOwnTime = [](std::atomic<double>& took, auto&& wait) {
        return std::thread([&took, wait] {
            const double begun = own_ms();
            wait();
            took = own_ms() - begun;
        });
    };
    auto polling = inOwnTime(polled_ms, [] { EXPECT_EQ(::poll(nullptr, 0, 100), 0); });
    auto waiting = inOwnTime(waited_ms, [] {
        std::mutex mutex;
        std::condition_variable never;
        std::unique_lock lock(mutex);
        EXPECT_FALSE(never.wait_for(lock, std::chrono::milliseconds(100), [] { return false; }));
    });
    auto sleeping = inOwnTime(slept_ms, [] { std::this_thread::sleep_for(std::chrono::milliseconds(100)); });
    ::usleep(20'000);  // 20 ms by the machine's clock, in which all of them wait
    const double machine = machine_ms(), own = own_ms();
    for (int i = 0; i < 3; ++i) standStill();
    EXPECT_GE(machine_ms() - machine, 180);
    EXPECT_LE(own_ms() - own, machine_ms() - machine - 120) << "at most 8 ms of each 60";
    polling.join();
    waiting.join();
    sleeping.join();
    EXPECT_GE(polled_ms, 100);
    EXPECT_GE(waited_ms, 100);
    EXPECT_GE(slept_ms, 100);
    EXPECT_LT(clock.asleep(), std::chrono::milliseconds(1)) << "the computer did not sleep";
}

TEST(PatientClock, GoesOnWithTheMachineAndNeverBack) {
    const double machine = machine_ms(), own = own_ms();
    double last = own;
    while (machine_ms() - machine < 200) {
        const double now = own_ms();
        ASSERT_GE(now, last);
        last = now;
    }
    EXPECT_LE(last - own, machine_ms() - machine + 8);
    EXPECT_GE(last - own, 1) << "an eighth of what the machine gives it";
}

TEST_F(InTimeExample, DISABLED_TellsHowFarItsClockIsBehind) { std::printf("%.3f\n", machine_ms() - own_ms()); }

TEST(PatientClock, IsThatOfAProgramThatTheTestStarts) {
    for (int i = 0; i < 3; ++i) standStill();
    const auto program = std::filesystem::read_symlink("/proc/self/exe").string();
    const auto command =
        program + " --gtest_also_run_disabled_tests --gtest_brief=1 --gtest_filter=*TellsHowFar* 2>&1 | grep '^[0-9]'";
    const double before = machine_ms() - own_ms();
    ASSERT_GE(before, 120);
    std::FILE* const said = ::popen(command.c_str(), "r");
    ASSERT_NE(said, nullptr);
    double theirs = 0;
    EXPECT_EQ(std::fscanf(said, "%lf", &theirs), 1);
    ::pclose(said);
    EXPECT_GE(theirs, before - 0.1);
    EXPECT_LE(theirs, machine_ms() - own_ms() + 0.1);
}
#endif

}  // namespace tacto::test
