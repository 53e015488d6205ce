// PassingStimulator.h - wraps a stimulator, for tests that change one detail of it.
//
// Thread-safety: as Stimulator.
#pragma once

#include <memory>
#include <utility>

#include "core/devices/Stimulator.h"

namespace tacto::test {

/// Forwards every call to the wrapped stimulator.
class PassingStimulator : public Stimulator {
public:
    explicit PassingStimulator(std::unique_ptr<Stimulator> inner) : inner_(std::move(inner)) {}
    const DeviceIdentity& identity() const noexcept override { return inner_->identity(); }
    const SourceTraits& traits() const noexcept override { return inner_->traits(); }
    Result<void> deliver(ApprovedTrain&& train) override { return inner_->deliver(std::move(train)); }
    Result<StimulatorStatus> status() override { return inner_->status(); }
    Result<void> keepAlive() override { return inner_->keepAlive(); }
    void forceOff() noexcept override { inner_->forceOff(); }

protected:
    [[nodiscard]] const Stimulator& inner() const noexcept { return *inner_; }

private:
    const std::unique_ptr<Stimulator> inner_;
};

}  // namespace tacto::test
