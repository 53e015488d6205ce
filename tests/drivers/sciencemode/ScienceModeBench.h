// ScienceModeBench.h - a ScienceMode stimulator on an emulated device, with a gate that approves for it.
//
// Thread-safety: the test's own thread.
#pragma once

#include "tests/drivers/sciencemode/EmulatedLine.h"
#include "tests/support/BenchGate.h"

namespace tacto::test {

/// Runs on the virtual clock, unless told otherwise.
class ScienceModeBench {
public:
    explicit ScienceModeBench(sciencemode::EmulatedSettings device = {}, sciencemode::StimulatorSettings settings = {});
    ~ScienceModeBench();

    /// Lets time pass; pulses are sent when they are due.
    void wait(Seconds duration);
    /// `pulses` biphasic pulses of `milliamps`, 200 µs a phase, 100 µs between, approved now.
    [[nodiscard]] ApprovedTrain approved(double milliamps, int pulses = 1, double rate_hz = 100);
    [[nodiscard]] ApprovedTrain approved(const PulseTrain& train, Seconds interval = Seconds(2));
    /// deliver(), then time for the train to end.
    [[nodiscard]] Result<void> deliver(const PulseTrain& train);
    /// The status, which must be there.
    [[nodiscard]] StimulatorStatus status();

    VirtualClock clock;
    std::shared_ptr<EmulatedLine> line;
    std::unique_ptr<sciencemode::ScienceModeStimulator> stimulator;

private:
    std::unique_ptr<SafetyGate> gate_;
};

/// A train as approved() makes it.
[[nodiscard]] PulseTrain biphasic(double milliamps, int pulses = 1, double rate_hz = 100);
/// Another program may have left this behind: a pulse every 50 ms in mid level. For inspect().
void startRepeating(sciencemode::EmulatedStimulator& device, Instant now);
/// Whether a train failed because a thread was late: a pulse, an answer, or a delivery after its approval expired.
[[nodiscard]] bool cameLate(const Error& error);

}  // namespace tacto::test
