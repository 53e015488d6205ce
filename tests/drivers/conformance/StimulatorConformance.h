// StimulatorConformance.h - what every stimulator must do, whatever its make. A driver's tests give a factory:
//
//   INSTANTIATE_TEST_SUITE_P(PulsePal, StimulatorConformance, testing::Values(StimulatorKind{"PulsePal", makeRig}));
//
// Thread-safety: the suite calls from its own thread, and forceOff() from others.
#pragma once

#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <string>

#include "core/devices/Stimulator.h"

namespace tacto::test {

/// A stimulator on a 1 kohm load (real, faked or simulated) with the means to look at it from outside.
class StimulatorRig {
public:
    virtual ~StimulatorRig() = default;
    [[nodiscard]] virtual Stimulator& device() = 0;
    [[nodiscard]] virtual const Clock& clock() const = 0;
    /// Lets time pass, for the clock and the device.
    virtual void wait(Seconds duration) = 0;
    /// Whether the output is on, seen from the load; nothing where the rig cannot see that.
    [[nodiscard]] virtual std::optional<bool> outputOn() = 0;
    /// Closes the device; outputOn() still answers.
    virtual void close() = 0;
    /// Pulls the plug; false where the rig cannot.
    [[nodiscard]] virtual bool unplug() = 0;
};

struct StimulatorKind {
    std::string name;
    std::function<std::unique_ptr<StimulatorRig>()> make;
};

class StimulatorConformance : public testing::TestWithParam<StimulatorKind> {
protected:
    void SetUp() override;
    /// `pulses` at 100 Hz of a small amplitude, approved now.
    [[nodiscard]] ApprovedTrain approved(int pulses = 1);
    [[nodiscard]] Stimulator& device() { return rig_->device(); }
    /// The status, read as the bench does.
    [[nodiscard]] StimulatorStatus status();
    void expectOutput(bool on);

    std::unique_ptr<StimulatorRig> rig_;
    std::unique_ptr<SafetyGate> gate_;
};

/// The amplitude that the tests use: 5 V or 5 mA.
[[nodiscard]] Amplitude smallAmplitude(const SourceTraits& source);

}  // namespace tacto::test
