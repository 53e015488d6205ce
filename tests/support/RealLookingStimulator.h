// RealLookingStimulator.h - a simulated stimulator that the bench takes for a real device.
//
// Thread-safety: as Stimulator.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "tests/support/PassingStimulator.h"

namespace tacto::test {

/// Reports itself as real hardware.
class RealLookingStimulator final : public PassingStimulator {
public:
    /// Has the twin's serial number, or `serial`; tests that run the whole program use one of their own (OwnSerial).
    explicit RealLookingStimulator(std::unique_ptr<Stimulator> twin, const std::string& serial = "")
        : PassingStimulator(std::move(twin)), identity_(inner().identity()) {
        identity_.simulated = false;
        if (!serial.empty()) identity_.serial = serial;
    }
    const DeviceIdentity& identity() const noexcept override { return identity_; }
    Result<void> deliver(ApprovedTrain&& train) override {
        ++delivered_;
        return PassingStimulator::deliver(std::move(train));
    }

    /// Returns the number of trains and impedance checks so far; for use on the virtual clock.
    [[nodiscard]] int delivered() const noexcept { return delivered_; }

private:
    DeviceIdentity identity_;
    int delivered_ = 0;
};

}  // namespace tacto::test
