// H2 end to end: another process sends a train of 20 s to the emulated stimulator through a terminal, and is killed or
// suspended. The device lives in this process, as hardware would: its output must end by itself.
#include <csignal>
#include <gtest/gtest.h>
#include <optional>
#include <thread>

#include "tests/support/Comes.h"
#include "tests/support/InTime.h"
#include "tests/support/OtherProgram.h"
#include "tests/support/Refused.h"
#include "tests/support/emulated/sciencemode/EmulatedPty.h"

namespace tacto::test {
namespace {

using namespace sciencemode;
using std::chrono::milliseconds;

class ScienceModeKill : public testing::Test {
protected:
    /// Returns once the host delivers. `again`: the host sends another train if the computer made one too late.
    void startHost(bool again = false) {
        RecordProperty("hazard", "H2");
        pty_ = accepted(EmulatedPty::open({}, clock_));
        std::vector<std::string> words{TACTO_HOST_PROGRAM, pty_->path()};
        if (again) words.emplace_back("again");
        host_.emplace(std::move(words));
        ASSERT_IN_TIME(host_->speaks()) << "the host ended without delivering";
    }
    /// Starts a train and waits until the driver's own thread has sent some of its pulses.
    void startTrain() {
        ASSERT_NO_FATAL_FAILURE(startHost());
        ASSERT_IN_TIME(comes([&] { return pulses() >= 4; }));
        ASSERT_IN_TIME(delivering());
    }
    static void passTime(milliseconds duration) { std::this_thread::sleep_for(duration); }
    /// True while pulses come; the train has twenty pulses a second.
    [[nodiscard]] bool delivering() { return clock_.now() - lastOutput() < milliseconds(500); }
    [[nodiscard]] std::size_t pulses() {
        return pty_->inspect([](auto& device, Instant now) { return device.pulses(now).size(); });
    }
    [[nodiscard]] Instant lastOutput() {
        return pty_->inspect([](auto& device, Instant now) { return device.pulses(now).back().end; });
    }

    SteadyClock clock_;
    std::unique_ptr<EmulatedPty> pty_;
    std::optional<HostProcess> host_;
};

TEST_F(ScienceModeKill, OutputEndsWithin2SecondsOfAKill) {
    ASSERT_NO_FATAL_FAILURE(startTrain());
    host_->signal(SIGKILL);
    const Instant killed = clock_.now();
    passTime(milliseconds(2600));
    EXPECT_FALSE(delivering());
    EXPECT_LE(lastOutput() - killed, milliseconds(2000));
}

TEST_F(ScienceModeKill, OutputEndsWithin2100MillisecondsOfAHangAndStaysOff) {
    ASSERT_NO_FATAL_FAILURE(startTrain());
    host_->signal(SIGSTOP);
    const Instant hung = clock_.now();
    passTime(milliseconds(2600));
    EXPECT_FALSE(delivering());
    EXPECT_LE(lastOutput() - hung, milliseconds(2100));
    const auto before = pulses();
    host_->signal(SIGCONT);
    passTime(milliseconds(600));
    // No program can be sure that it is not stopped between judging a pulse and writing it (safety.md, H2).
    const auto after = pulses();
    EXPECT_LE(after - before, 1U) << "the one that was being written";
    passTime(milliseconds(600));
    EXPECT_EQ(pulses(), after) << "a host that wakes up revives nothing";
}

TEST_F(ScienceModeKill, ControlRunGoesOnFor10Seconds) {
    // The run needs 200 answers, and a busy computer may be late with one: the host then sends another train.
    ASSERT_NO_FATAL_FAILURE(startHost(true));
    const Instant begun = clock_.now();
    passTime(milliseconds(10'000));
    EXPECT_IN_TIME(delivering());
    EXPECT_IN_TIME(lastOutput() - begun >= milliseconds(9'400));
}

}  // namespace
}  // namespace tacto::test
