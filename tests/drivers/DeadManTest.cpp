// H2 end to end: a device with a train of 20 s lives in this process, as the hardware would. Its host is a child
// process that sends heartbeats through a pipe. Whatever happens to the host, the output must end.
#include <chrono>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "drivers/simulated/SimulatedDriver.h"
#include "drivers/simulated/SimulatedStimulator.h"
#include "tests/drivers/SimBench.h"
#include "tests/support/BenchGate.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

constexpr Seconds kHeartbeat{0.05};

/// The host: sends heartbeats until it is killed, stopped or orphaned.
class BeatingHost {
public:
    BeatingHost() {
        int ends[2];
        if (pipe(ends) != 0) throw std::runtime_error("no pipe");
        child_ = fork();
        if (child_ < 0) throw std::runtime_error("no child process");
        if (child_ == 0) {
            close(ends[0]);
            signal(SIGPIPE, SIG_DFL);
            for (;;) {
                if (write(ends[1], "k", 1) != 1) _exit(1);
                usleep(static_cast<useconds_t>(kHeartbeat.count() * 1e6));
            }
        }
        close(ends[1]);
        pipe_ = ends[0];
    }
    BeatingHost(const BeatingHost&) = delete;
    BeatingHost& operator=(const BeatingHost&) = delete;
    ~BeatingHost() {
        kill(child_, SIGKILL);
        waitpid(child_, nullptr, 0);
        close(pipe_);
    }

    /// Waits up to `longest`; returns true if a heartbeat came.
    [[nodiscard]] bool beat(std::chrono::milliseconds longest) const {
        pollfd wait{pipe_, POLLIN, 0};
        if (poll(&wait, 1, static_cast<int>(longest.count())) <= 0) return false;
        char bytes[64];
        if (read(pipe_, bytes, sizeof bytes) > 0) return true;
        std::this_thread::sleep_for(longest);  // the host is gone, so the pipe stays at its end
        return false;
    }
    void send(int signalNumber) const { kill(child_, signalNumber); }

private:
    pid_t child_ = -1;
    int pipe_ = -1;
};

class DeadMan : public testing::Test {
protected:
    void SetUp() override {
        RecordProperty("hazard", "H2");
        const auto opened =
            makeSimulatedDriver()->open({"sim", "stimulator", {}}, {}, OpenContext{clock_, 1, "1 kohm"}, devices_);
        ASSERT_IN_TIME(opened);
        circuit_ = &dynamic_cast<sim::WorldMember&>(*devices_.stimulator).world()->circuit();
    }

    /// Starts the train, 50 pulses a second. Asks the gate just before, because its approvals expire soon.
    void begin() {
        const auto gate = benchGate(clock_, devices_.stimulator->traits());
        auto train = voltagePulse(5);
        train.pulses = 1000;
        train.rate = Hertz(50);
        const auto begun = devices_.stimulator->deliver(approve(*gate, clock_, train, Seconds(22)));
        ASSERT_IN_TIME(begun);
    }

    /// Passes the host's heartbeats on to the device for `duration`.
    void runFor(Seconds duration) {
        const Instant end = clock_.now() + toInstant(duration);
        while (clock_.now() < end) {
            if (host_.beat(std::chrono::milliseconds(10))) {
                EXPECT_IN_TIME(devices_.stimulator->keepAlive());
            }
        }
    }

    /// Runs until just after a heartbeat, so that none is left in the pipe.
    void runToHeartbeat() {
        for (int i = 0; i < 1000 && !host_.beat(std::chrono::milliseconds(10)); ++i) {
        }
        EXPECT_IN_TIME(devices_.stimulator->keepAlive());
    }

    [[nodiscard]] bool outputOn() { return circuit_->active(clock_.now()); }
    /// Returns the end of the newest pulse.
    [[nodiscard]] Instant lastOutput() {
        return circuit_->inspect(clock_.now(), [](const auto& pulses) { return toInstant(pulses.back().end_s); });
    }

    SteadyClock clock_;
    DeviceSet devices_;
    sim::SimulatedCircuit* circuit_ = nullptr;
    BeatingHost host_;
};

TEST_F(DeadMan, OutputEndsWithin2SecondsOfAKill) {
    ASSERT_NO_FATAL_FAILURE(begin());
    runFor(Seconds(1));
    ASSERT_IN_TIME(outputOn());
    runToHeartbeat();
    host_.send(SIGKILL);
    const Instant killed = clock_.now();
    runFor(Seconds(2.5));
    EXPECT_FALSE(outputOn());
    EXPECT_LE(lastOutput() - killed, std::chrono::milliseconds(2000));
    EXPECT_IN_TIME(lastOutput() - killed >= std::chrono::milliseconds(1700))
        << "it would have gone on without the kill";
}

TEST_F(DeadMan, OutputEndsWithin2100MillisecondsOfAHang) {
    ASSERT_NO_FATAL_FAILURE(begin());
    runFor(Seconds(1));
    ASSERT_IN_TIME(outputOn());
    runToHeartbeat();
    host_.send(SIGSTOP);
    const Instant hung = clock_.now();
    runFor(Seconds(2.5));
    EXPECT_FALSE(outputOn());
    EXPECT_LE(lastOutput() - hung, std::chrono::milliseconds(2100));
    host_.send(SIGCONT);  // a host that continues must not switch the output on again
    runFor(Seconds(0.5));
    EXPECT_FALSE(outputOn());
}

TEST_F(DeadMan, ControlRunWithHeartbeatGoesOnFor10Seconds) {
    ASSERT_NO_FATAL_FAILURE(begin());
    runFor(Seconds(10));
    EXPECT_IN_TIME(outputOn());
    EXPECT_IN_TIME(clock_.now() - lastOutput() <= std::chrono::milliseconds(100));
    EXPECT_IN_TIME(circuit_->inspect(clock_.now(), [](const auto& pulses) { return pulses.back().number; }) >= 490U);
}

}  // namespace
}  // namespace tacto::test
