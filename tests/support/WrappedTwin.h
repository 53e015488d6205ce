// WrappedTwin.h - the simulated bench with a test's own wrapper around its stimulator.
//
// Thread-safety: as Driver and Stimulator.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/devices/Registry.h"
#include "core/devices/Stimulator.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "drivers/simulated/World.h"
#include "tests/support/PassingStimulator.h"

namespace tacto::test {

/// Also forwards what the bench and the other simulated devices ask of a simulated stimulator.
class WrappedStimulator : public PassingStimulator, public StatesCalibration, public sim::WorldMember {
public:
    using PassingStimulator::PassingStimulator;
    const KnownLines& statedCalibration() const noexcept override {
        return dynamic_cast<const StatesCalibration&>(inner()).statedCalibration();
    }
    const std::shared_ptr<sim::World>& world() const noexcept override {
        return dynamic_cast<const sim::WorldMember&>(inner()).world();
    }
};

class WrappedBench final : public Driver {
public:
    /// Called when the driver opens its stimulator; returns the wrapped stimulator.
    using Wrap = std::function<std::unique_ptr<Stimulator>(std::unique_ptr<Stimulator>, const OpenContext&)>;

    /// `virtualTime`: true if the bench runs on the virtual clock; empty: as the driver of "sim:" itself.
    explicit WrappedBench(Wrap wrap, std::optional<bool> virtualTime = {})
        : wrap_(std::move(wrap)), virtualTime_(virtualTime.value_or(twin_->runsOnVirtualClock())) {}
    std::string_view scheme() const noexcept override { return twin_->scheme(); }
    std::vector<DeviceIdentity> list() const override { return twin_->list(); }
    bool runsOnVirtualClock() const noexcept override { return virtualTime_; }
    Result<void> open(const DeviceUri& uri, const std::set<Role>& wanted, const OpenContext& context,
                      DeviceSet& into) override {
        const bool had = into.stimulator != nullptr;
        auto opened = twin_->open(uri, wanted, context, into);
        if (!had && into.stimulator) into.stimulator = wrap_(std::move(into.stimulator), context);
        return opened;
    }

private:
    const std::unique_ptr<Driver> twin_ = makeSimulatedDriver();
    const Wrap wrap_;
    const bool virtualTime_;
};

}  // namespace tacto::test
