// SimBench.h - the fixture of these tests: simulated devices on a virtual clock, and a gate that approves trains.
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

    /// Opens one URI; if that fails, so does the test, with the reason.
    /// Devices have no flaws unless `uri` asks for them: these tests look at one flaw at a time.
    void open(std::string_view uri, const std::set<Role>& wanted = {});
    /// Opens like open(), for URIs that may be refused.
    [[nodiscard]] Result<void> tryOpen(std::string_view uri, const std::set<Role>& wanted = {});
    void wait(Seconds duration) { clock.advanceTo(clock.now() + toInstant(duration)); }

    /// Approves a symmetric train of 200 µs a phase for the open stimulator.
    [[nodiscard]] ApprovedTrain approved(const PulseTrain& train);
    /// Delivers the train and waits `after`. If the device refuses, the test fails.
    void deliver(const PulseTrain& train, Seconds after = Seconds(0.06));
    /// Applies the oscilloscope settings, then arms.
    void arm(const ScopeSettings& settings);
    /// Returns the next capture; if there is none, the test fails.
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

/// Makes a train of one pulse of `volts`, 200 µs a phase.
[[nodiscard]] PulseTrain voltagePulse(double volts, double gap_us = 100);
[[nodiscard]] PulseTrain currentPulse(double milliamps, double gap_us = 100);
/// Returns the largest magnitude of a channel.
[[nodiscard]] double peakOf(const CaptureChannel& channel);

}  // namespace tacto::test
