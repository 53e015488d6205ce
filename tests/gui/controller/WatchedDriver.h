// WatchedDriver.h - the simulated bench with an eye and a hand on its stimulator: a test sees every train that reaches
// it, and may do something at any call of it, or while the driver opens it.
//
// Thread-safety: what is atomic from any thread; the hooks are set before a bench is opened, and called by the
// device's thread.
#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "core/devices/Registry.h"
#include "drivers/simulated/SimulatedDriver.h"

namespace tacto::test {

/// Shared by the test, the driver and its stimulator. The hooks are set before the controller is told anything.
struct Watch {
    std::atomic<int> calls{0};  ///< of the stimulator, forceOff() apart
    std::atomic<int> trains{0};
    std::atomic<int> offs{0};
    std::function<void(const OpenContext&)> onOpen;  ///< the stimulator is open, and open() has not returned
    std::function<void(int)> onCall;                 ///< before each call, with its number
    std::function<void()> onOff;
};

class WatchedStimulator final : public Stimulator {
public:
    WatchedStimulator(std::unique_ptr<Stimulator> inner, std::shared_ptr<Watch> watch)
        : inner_(std::move(inner)), watch_(std::move(watch)) {}
    const DeviceIdentity& identity() const noexcept override {
        called();
        return inner_->identity();
    }
    const SourceTraits& traits() const noexcept override { return inner_->traits(); }
    Result<void> deliver(ApprovedTrain&& train) override {
        called();
        ++watch_->trains;
        return inner_->deliver(std::move(train));
    }
    Result<StimulatorStatus> status() override {
        called();
        return inner_->status();
    }
    Result<void> keepAlive() override {
        called();
        return inner_->keepAlive();
    }
    void forceOff() noexcept override {
        ++watch_->offs;
        inner_->forceOff();
        if (watch_->onOff) watch_->onOff();
    }

private:
    void called() const {
        const int number = ++watch_->calls;
        if (watch_->onCall) watch_->onCall(number);
    }
    const std::unique_ptr<Stimulator> inner_;
    const std::shared_ptr<Watch> watch_;
};

class WatchedDriver final : public Driver {
public:
    /// `virtualTime`: as sim: itself; else the bench runs on the steady clock.
    explicit WatchedDriver(std::shared_ptr<Watch> watch, bool virtualTime = true)
        : watch_(std::move(watch)), virtualTime_(virtualTime) {}
    std::string_view scheme() const noexcept override { return inner_->scheme(); }
    std::vector<DeviceIdentity> list() const override { return inner_->list(); }
    bool runsOnVirtualClock() const noexcept override { return virtualTime_; }
    Result<void> open(const DeviceUri& uri, const std::set<Role>& wanted, const OpenContext& context,
                      DeviceSet& into) override {
        const bool had = into.stimulator != nullptr;
        auto opened = inner_->open(uri, wanted, context, into);
        if (had || !into.stimulator) return opened;
        into.stimulator = std::make_unique<WatchedStimulator>(std::move(into.stimulator), watch_);
        if (watch_->onOpen) watch_->onOpen(context);
        return opened;
    }

private:
    const std::unique_ptr<Driver> inner_ = makeSimulatedDriver();
    const std::shared_ptr<Watch> watch_;
    const bool virtualTime_;
};

[[nodiscard]] inline std::function<Registry()> watchedRegistry(const std::shared_ptr<Watch>& watch,
                                                               bool virtualTime = true) {
    return [watch, virtualTime] {
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(std::make_unique<WatchedDriver>(watch, virtualTime));
        return Registry(std::move(drivers));
    };
}

}  // namespace tacto::test
