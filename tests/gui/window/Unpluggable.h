// Unpluggable.h - the simulated bench with a stimulator that a test unplugs when it wants to, however long the machine
// took until then.
//
// Thread-safety: Plug from any thread; the rest as Driver and Stimulator.
#pragma once

#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "core/devices/Registry.h"
#include "core/devices/StatesCalibration.h"
#include "core/devices/Stimulator.h"
#include "drivers/replay/ReplayDrivers.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "drivers/simulated/World.h"

namespace tacto::test {

using Plug = std::shared_ptr<std::atomic<bool>>;  ///< true: it is in

/// The twin, with all that others ask a simulated stimulator for.
class UnpluggableStimulator final : public Stimulator, public StatesCalibration, public sim::WorldMember {
public:
    UnpluggableStimulator(std::unique_ptr<Stimulator> twin, Plug plug)
        : twin_(std::move(twin)), plug_(std::move(plug)) {}
    const DeviceIdentity& identity() const noexcept override { return twin_->identity(); }
    const SourceTraits& traits() const noexcept override { return twin_->traits(); }
    Result<void> deliver(ApprovedTrain&& train) override { return *plug_ ? twin_->deliver(std::move(train)) : out(); }
    Result<StimulatorStatus> status() override { return *plug_ ? twin_->status() : out(); }
    Result<void> keepAlive() override { return *plug_ ? twin_->keepAlive() : out(); }
    void forceOff() noexcept override { twin_->forceOff(); }
    const KnownLines& statedCalibration() const noexcept override {
        return dynamic_cast<const StatesCalibration&>(*twin_).statedCalibration();
    }
    const std::shared_ptr<sim::World>& world() const noexcept override {
        return dynamic_cast<const sim::WorldMember&>(*twin_).world();
    }

private:
    static tl::unexpected<Error> out() { return fail(ErrorCode::Device, "the simulated stimulator is unplugged"); }

    std::unique_ptr<Stimulator> twin_;
    Plug plug_;
};

class UnpluggableBench final : public Driver {
public:
    explicit UnpluggableBench(Plug plug) : bench_(makeSimulatedDriver()), plug_(std::move(plug)) {}
    std::string_view scheme() const noexcept override { return bench_->scheme(); }
    std::vector<DeviceIdentity> list() const override { return bench_->list(); }
    bool runsOnVirtualClock() const noexcept override { return bench_->runsOnVirtualClock(); }
    Result<void> open(const DeviceUri& uri, const std::set<Role>& wanted, const OpenContext& context,
                      DeviceSet& into) override {
        const bool had = into.stimulator != nullptr;
        auto opened = bench_->open(uri, wanted, context, into);
        if (!had && into.stimulator != nullptr)
            into.stimulator = std::make_unique<UnpluggableStimulator>(std::move(into.stimulator), plug_);
        return opened;
    }

private:
    std::unique_ptr<Driver> bench_;
    Plug plug_;
};

/// As simulatedRegistry().
[[nodiscard]] inline Registry unpluggableRegistry(const Plug& plug) {
    std::vector<std::unique_ptr<Driver>> drivers;
    drivers.push_back(std::make_unique<UnpluggableBench>(plug));
    drivers.push_back(makeRecordingDriver());
    drivers.push_back(makeCaptureDriver());
    return Registry(std::move(drivers));
}

}  // namespace tacto::test
