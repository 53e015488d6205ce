// StimulatorConformance.h - tests that every stimulator must pass, whatever its make. A driver's tests give a factory:
//
//   INSTANTIATE_TEST_SUITE_P(PulsePal, StimulatorConformance, testing::Values(StimulatorKind{"PulsePal", makeRig}));
//
// Thread-safety: the suite calls from its own thread, but forceOff() from other threads too.
#pragma once

#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <string>

#include "core/devices/Stimulator.h"

namespace tacto::test {

/// A stimulator on a 1 kohm load (real, faked or simulated), with functions to observe it from outside.
class StimulatorRig {
public:
    virtual ~StimulatorRig() = default;
    [[nodiscard]] virtual Stimulator& device() = 0;
    [[nodiscard]] virtual const Clock& clock() const = 0;
    /// Lets time pass, for the clock and the device.
    virtual void wait(Seconds duration) = 0;
    /// True if the output, measured at the load, is on; nothing if the rig cannot measure it.
    [[nodiscard]] virtual std::optional<bool> outputOn() = 0;
    /// Closes the device; outputOn() still works afterwards.
    virtual void close() = 0;
    /// Pulls the plug; returns false if the rig cannot.
    [[nodiscard]] virtual bool unplug() = 0;
};

struct StimulatorKind {
    std::string name;
    std::function<std::unique_ptr<StimulatorRig>()> make;
};

class StimulatorConformance : public testing::TestWithParam<StimulatorKind> {
protected:
    void SetUp() override;
    /// Approves `pulses` pulses of a small amplitude at 100 Hz.
    [[nodiscard]] ApprovedTrain approved(int pulses = 1);
    [[nodiscard]] Stimulator& device() { return rig_->device(); }
    /// Returns the status as the bench would read it.
    [[nodiscard]] StimulatorStatus status();
    void expectOutput(bool on);

    std::unique_ptr<StimulatorRig> rig_;
    std::unique_ptr<SafetyGate> gate_;
};

/// Returns the amplitude that the tests use: 5 V or 5 mA.
[[nodiscard]] Amplitude smallAmplitude(const SourceTraits& source);

}  // namespace tacto::test
