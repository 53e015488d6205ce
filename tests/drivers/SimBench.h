// SimBench.h - simulated devices on a virtual clock, with a gate that approves for them: the fixture of these tests.
//
// Thread-safety: the test's own thread.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/devices/Driver.h"
#include "drivers/simulated/SimulatedStimulator.h"

namespace tacto::test {

class SimBench {
public:
    explicit SimBench(std::string declaredLoad = "1 kohm", std::uint64_t seed = 1);

    /// Opens one URI; failing that, the test's failure says why.
    /// Without flaws unless `uri` says otherwise: these tests look at one flaw at a time.
    void open(std::string_view uri, const std::set<Role>& wanted = {});
    /// Opens like open(), for what should be refused.
    [[nodiscard]] Result<void> tryOpen(std::string_view uri, const std::set<Role>& wanted = {});
    void wait(Seconds duration) { clock.advanceTo(clock.now() + toInstant(duration)); }

    /// A symmetric train at 200 µs a phase, approved for the open stimulator.
    [[nodiscard]] ApprovedTrain approved(const PulseTrain& train);
    /// Delivers and waits `after`. The test fails when the device refuses.
    void deliver(const PulseTrain& train, Seconds after = Seconds(0.06));
    /// Oscilloscope settings applied, then armed.
    void arm(const ScopeSettings& settings);
    /// The next capture, which must be there.
    [[nodiscard]] Capture capture();
    [[nodiscard]] sim::SimulatedCircuit& circuit();

    VirtualClock clock;
    DeviceSet devices;

private:
    std::unique_ptr<Driver> driver_;
    std::string declaredLoad_;
    std::uint64_t seed_;
    std::unique_ptr<SafetyGate> gate_;
};

/// A train of one pulse at `volts`, 200 µs a phase.
[[nodiscard]] PulseTrain voltagePulse(double volts, double gap_us = 100);
[[nodiscard]] PulseTrain currentPulse(double milliamps, double gap_us = 100);
/// Largest magnitude of a channel.
[[nodiscard]] double peakOf(const CaptureChannel& channel);

}  // namespace tacto::test
