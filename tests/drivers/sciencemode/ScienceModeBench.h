// ScienceModeBench.h - a ScienceMode stimulator on an emulated device, with a gate that approves its trains.
//
// Thread-safety: the test's own thread.
#pragma once

#include "tests/drivers/sciencemode/EmulatedLine.h"
#include "tests/support/BenchGate.h"

namespace tacto::test {

/// Uses the virtual clock, unless another one is given.
class ScienceModeBench {
public:
    explicit ScienceModeBench(sciencemode::EmulatedSettings device = {}, sciencemode::StimulatorSettings settings = {});
    ~ScienceModeBench();

    /// Lets time pass; due pulses are sent meanwhile.
    void wait(Seconds duration);
    /// Approves `pulses` biphasic pulses of `milliamps`, 200 µs a phase, 100 µs between the phases.
    [[nodiscard]] ApprovedTrain approved(double milliamps, int pulses = 1, double rate_hz = 100);
    [[nodiscard]] ApprovedTrain approved(const PulseTrain& train, Seconds interval = Seconds(2));
    /// Calls deliver(), then waits until the train has ended.
    [[nodiscard]] Result<void> deliver(const PulseTrain& train);
    /// Returns the status; if there is none, the test fails.
    [[nodiscard]] StimulatorStatus status();

    VirtualClock clock;
    std::shared_ptr<EmulatedLine> line;
    std::unique_ptr<sciencemode::ScienceModeStimulator> stimulator;

private:
    std::unique_ptr<SafetyGate> gate_;
};

/// Makes the train that approved() approves.
[[nodiscard]] PulseTrain biphasic(double milliamps, int pulses = 1, double rate_hz = 100);
/// Starts a pulse every 50 ms in mid level, as another program may have done. For use in inspect().
void startRepeating(sciencemode::EmulatedStimulator& device, Instant now);
/// True if a train failed because of a late thread: a late pulse or answer, or a delivery after the approval expired.
[[nodiscard]] bool cameLate(const Error& error);

}  // namespace tacto::test
