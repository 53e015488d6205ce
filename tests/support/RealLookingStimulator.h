// RealLookingStimulator.h - a twin that a bench takes for a device.
//
// Thread-safety: as Stimulator.
#pragma once

#include <memory>
#include <utility>

#include "tests/support/PassingStimulator.h"

namespace tacto::test {

/// Reports itself as real hardware.
class RealLookingStimulator final : public PassingStimulator {
public:
    explicit RealLookingStimulator(std::unique_ptr<Stimulator> twin)
        : PassingStimulator(std::move(twin)), identity_(inner().identity()) {
        identity_.simulated = false;
    }
    const DeviceIdentity& identity() const noexcept override { return identity_; }
    Result<void> deliver(ApprovedTrain&& train) override {
        ++delivered_;
        return PassingStimulator::deliver(std::move(train));
    }

    /// Trains and impedance checks so far; on the virtual clock.
    [[nodiscard]] int delivered() const noexcept { return delivered_; }

private:
    DeviceIdentity identity_;
    int delivered_ = 0;
};

}  // namespace tacto::test
