// H2 end to end: SIGSTOP stops a process that delivers trains, and SIGCONT continues it. Its threads then race, so the
// test has many trials. After SIGCONT no train may reach the device until the operator arms again.
#include <charconv>
#include <csignal>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <thread>

#include "core/base/Random.h"
#include "tests/support/InTime.h"
#include "tests/support/OtherProgram.h"
#include "tests/support/Trials.h"
#include "tests/support/emulated/sciencemode/EmulatedPty.h"

namespace tacto::test {
namespace {

using std::chrono::milliseconds;

std::int64_t monotonic_ns() {
    std::timespec at{};
    clock_gettime(CLOCK_MONOTONIC, &at);
    return at.tv_sec * 1'000'000'000L + at.tv_nsec;
}

/// The process that delivers.
class Host : public HostProcess {
public:
    explicit Host(const std::string& which) : HostProcess({TACTO_SUSPEND_HOST, which}) {}

    /// Sends a command and returns its answer; keeps the trains printed before it. Empty after 20 s.
    [[nodiscard]] std::string ask(const std::string& command) {
        if (!tell(command)) return {};
        for (;;) {
            const auto said = readLine();
            if (!said) return {};
            if (!said->starts_with("train ")) return *said;
            std::int64_t at = 0;
            std::from_chars(said->data() + 6, said->data() + said->size(), at);
            trains_.push_back(at);
        }
    }
    /// Returns the CLOCK_MONOTONIC time of each write to the device.
    [[nodiscard]] const std::vector<std::int64_t>& trains() const { return trains_; }

private:
    std::vector<std::int64_t> trains_;
};

struct Tried {
    int trials = 0;
    int wentOn = 0;  ///< trials in which it delivered again without arming
};

/// Stops and continues `host` at random moments. `outputSince` counts the device's own output after a given time of
/// CLOCK_MONOTONIC.
template <class OutputSince>
void tryManyTimes(Host& host, OutputSince outputSince) {
    const int wanted = raceTrials();
    const std::uint64_t seed = std::random_device{}();
    testing::Test::RecordProperty("seed", std::to_string(seed));
    Random random(seed, "suspended process");
    Tried tried;
    // If the computer stalls, the bench faults before the trial: the trial then does not count.
    for (int attempt = 0; tried.trials < wanted && attempt < 3 * wanted; ++attempt) {
        const auto gone = host.ask("go");
        ASSERT_IN_TIME(!gone.empty());
        if (gone != "on") continue;
        std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(250 * random.uniform()));
        if (!host.ask("state").starts_with("state delivering")) continue;
        ASSERT_TRUE(host.stopAndWait());
        std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(130 + 120 * random.uniform()));
        const auto continued = monotonic_ns();
        host.signal(SIGCONT);
        ++tried.trials;
        // A bench that wrongly continues delivers within 0.5 s; otherwise it reports the fault within milliseconds.
        constexpr std::string_view kFaulted = "state faulted the control loop was silent for more than 100 ms";
        std::string state;
        for (int look = 0; look < 60 && state != kFaulted; ++look) {
            if (look > 0) std::this_thread::sleep_for(milliseconds(10));
            state = host.ask("state");
        }
        EXPECT_IN_TIME(state == kFaulted) << "trial " << tried.trials << ", seed " << seed;
        int after = 0;
        for (const auto at : host.trains()) after += at >= continued ? 1 : 0;
        after += outputSince(continued);
        if (after > 0) ++tried.wentOn;
        EXPECT_EQ(after, 0) << "trial " << tried.trials << ", seed " << seed;
    }
    testing::Test::RecordProperty("trials", tried.trials);
    EXPECT_EQ(tried.wentOn, 0) << "of " << tried.trials << " trials";
    EXPECT_IN_TIME(tried.trials == wanted) << "the machine is too busy for the rest";
}

TEST(SuspendedProcess, DeliversNothingThroughTheSimulatedStimulator) {
    testing::Test::RecordProperty("hazard", "H2");
    Host host("sim");
    tryManyTimes(host, [](std::int64_t) { return 0; });
}

TEST(SuspendedProcess, DeliversNothingThroughAMassager) {
    testing::Test::RecordProperty("hazard", "H2");
    Host host("massager");
    tryManyTimes(host, [](std::int64_t) { return 0; });
}

TEST(SuspendedProcess, ProgramsNothingIntoAPulsePal) {
    testing::Test::RecordProperty("hazard", "H2");
    Host host("pulsepal");
    tryManyTimes(host, [](std::int64_t) { return 0; });
}

TEST(SuspendedProcess, DeliversNothingThroughAScienceModeStimulatorNotEvenTheRestOfATrain) {
    testing::Test::RecordProperty("hazard", "H2");
    const SteadyClock clock;
    const auto begun = monotonic_ns() - clock.now().count();
    auto pty = sciencemode::EmulatedPty::open({}, clock);
    ASSERT_IN_TIME(pty);
    Host host((*pty)->path());
    tryManyTimes(host, [&](std::int64_t since) {
        return (*pty)->inspect([&](auto& device, Instant now) {
            int pulses = 0;
            for (const auto& pulse : device.pulses(now)) pulses += begun + pulse.onset.count() > since ? 1 : 0;
            return pulses;
        });
    });
}

}  // namespace
}  // namespace tacto::test
