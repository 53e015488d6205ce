// RealLookingStimulator.h - a twin that a bench takes for a device.
//
// Thread-safety: as Stimulator.
#pragma once

#include <memory>

#include "core/devices/Stimulator.h"

namespace tacto::test {

/// Passes everything on and says that it is real.
class RealLookingStimulator final : public Stimulator {
public:
    explicit RealLookingStimulator(std::unique_ptr<Stimulator> twin)
        : twin_(std::move(twin)), identity_(twin_->identity()) {
        identity_.simulated = false;
    }
    const DeviceIdentity& identity() const noexcept override { return identity_; }
    const SourceTraits& traits() const noexcept override { return twin_->traits(); }
    Result<void> deliver(ApprovedTrain&& train) override {
        ++delivered_;
        return twin_->deliver(std::move(train));
    }
    Result<StimulatorStatus> status() override { return twin_->status(); }
    Result<void> keepAlive() override { return twin_->keepAlive(); }
    void forceOff() noexcept override { twin_->forceOff(); }

    /// Trains and impedance checks so far; on the virtual clock.
    [[nodiscard]] int delivered() const noexcept { return delivered_; }

private:
    std::unique_ptr<Stimulator> twin_;
    DeviceIdentity identity_;
    int delivered_ = 0;
};

}  // namespace tacto::test
