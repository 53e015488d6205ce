// H2 end to end: another process sends a train of 20 s to the emulated stimulator through a terminal, and is killed or
// hung. The device lives here, as hardware would: what it puts out must end by itself.
#include <array>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "tests/support/Comes.h"
#include "tests/support/InTime.h"
#include "tests/support/emulated/sciencemode/EmulatedPty.h"

namespace tacto::test {
namespace {

using namespace sciencemode;
using std::chrono::milliseconds;

class ScienceModeKill : public testing::Test {
protected:
    /// Returns once the host delivers. `again`: it sends another train where the machine made one too late.
    void startHost(bool again = false) {
        RecordProperty("hazard", "H2");
        auto pty = EmulatedPty::open({}, clock_);
        ASSERT_TRUE(pty.has_value()) << pty.error().message;
        pty_ = std::move(*pty);
        std::array<int, 2> ends{};
        ASSERT_EQ(pipe(ends.data()), 0);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        posix_spawn_file_actions_addclose(&actions, ends[0]);
        std::string program = TACTO_HOST_PROGRAM;
        std::string terminal = pty_->path();
        std::string more = "again";
        std::array<char*, 4> arguments{program.data(), terminal.data(), again ? more.data() : nullptr, nullptr};
        const int spawned = posix_spawn(&host_, program.c_str(), &actions, nullptr, arguments.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        close(ends[1]);
        ASSERT_EQ(spawned, 0);
        char first = 0;
        const auto came = read(ends[0], &first, 1);
        output_ = ends[0];  // open, so that the host may print more
        ASSERT_IN_TIME(came == 1) << "the host ended without delivering";
    }
    /// The train goes on by itself: the driver's own thread has sent some of it.
    void startTrain() {
        ASSERT_NO_FATAL_FAILURE(startHost());
        ASSERT_IN_TIME(comes([&] { return pulses() >= 4; }));
        ASSERT_IN_TIME(delivering());
    }
    void TearDown() override {
        if (output_ >= 0) close(output_);
        if (host_ <= 0) return;
        kill(host_, SIGKILL);
        waitpid(host_, nullptr, 0);
    }

    static void passTime(milliseconds duration) { std::this_thread::sleep_for(duration); }
    /// Twenty pulses a second.
    [[nodiscard]] bool delivering() { return clock_.now() - lastOutput() < milliseconds(500); }
    [[nodiscard]] std::size_t pulses() {
        return pty_->inspect([](auto& device, Instant now) { return device.pulses(now).size(); });
    }
    [[nodiscard]] Instant lastOutput() {
        return pty_->inspect([](auto& device, Instant now) { return device.pulses(now).back().end; });
    }

    SteadyClock clock_;
    std::unique_ptr<EmulatedPty> pty_;
    pid_t host_ = -1;
    int output_ = -1;  // what the host prints
};

TEST_F(ScienceModeKill, OutputEndsWithin2SecondsOfAKill) {
    ASSERT_NO_FATAL_FAILURE(startTrain());
    kill(host_, SIGKILL);
    const Instant killed = clock_.now();
    passTime(milliseconds(2600));
    EXPECT_FALSE(delivering());
    EXPECT_LE(lastOutput() - killed, milliseconds(2000));
}

TEST_F(ScienceModeKill, OutputEndsWithin2100MillisecondsOfAHangAndStaysOff) {
    ASSERT_NO_FATAL_FAILURE(startTrain());
    kill(host_, SIGSTOP);
    const Instant hung = clock_.now();
    passTime(milliseconds(2600));
    EXPECT_FALSE(delivering());
    EXPECT_LE(lastOutput() - hung, milliseconds(2100));
    kill(host_, SIGCONT);
    passTime(milliseconds(600));
    EXPECT_FALSE(delivering()) << "a host that wakes up revives nothing";
}

TEST_F(ScienceModeKill, ControlRunGoesOnFor10Seconds) {
    // 200 answers, of which a busy machine makes one late: then the train is given up, and the host sends another.
    ASSERT_NO_FATAL_FAILURE(startHost(true));
    const Instant begun = clock_.now();
    passTime(milliseconds(10'000));
    EXPECT_IN_TIME(delivering());
    EXPECT_IN_TIME(lastOutput() - begun >= milliseconds(9'400));
}

}  // namespace
}  // namespace tacto::test
