// WatchedDriver.h - the simulated bench with a watched stimulator: a test sees every train that reaches the stimulator,
// and can act at any of its calls or while the driver opens it.
//
// Thread-safety: atomic members from any thread. The hooks are set before a bench is opened, and the device's thread
// calls them.
#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "tests/support/WrappedTwin.h"

namespace tacto::test {

/// Shared by the test, the driver and the stimulator. Set the hooks before the first call of the controller.
struct Watch {
    std::atomic<int> calls{0};  ///< number of calls of the stimulator, without forceOff()
    std::atomic<int> trains{0};
    std::atomic<int> offs{0};
    std::function<void(const OpenContext&)> onOpen;  ///< called when the stimulator is open, before open() returns
    std::function<void(int)> onCall;                 ///< called before each call, with the number of the call
    std::function<void()> onOff;
};

class WatchedStimulator final : public WrappedStimulator {
public:
    WatchedStimulator(std::unique_ptr<Stimulator> twin, std::shared_ptr<Watch> watch)
        : WrappedStimulator(std::move(twin)), watch_(std::move(watch)) {}
    const DeviceIdentity& identity() const noexcept override {
        called();
        return WrappedStimulator::identity();
    }
    Result<void> deliver(ApprovedTrain&& train) override {
        called();
        ++watch_->trains;
        return WrappedStimulator::deliver(std::move(train));
    }
    Result<StimulatorStatus> status() override {
        called();
        return WrappedStimulator::status();
    }
    Result<void> keepAlive() override {
        called();
        return WrappedStimulator::keepAlive();
    }
    void forceOff() noexcept override {
        ++watch_->offs;
        WrappedStimulator::forceOff();
        if (watch_->onOff) watch_->onOff();
    }

private:
    void called() const {
        const int number = ++watch_->calls;
        if (watch_->onCall) watch_->onCall(number);
    }
    const std::shared_ptr<Watch> watch_;
};

/// `virtualTime`: uses virtual time, like sim: itself; otherwise the bench runs on the steady clock.
[[nodiscard]] inline std::function<Registry()> watchedRegistry(const std::shared_ptr<Watch>& watch,
                                                               bool virtualTime = true) {
    return [watch, virtualTime] {
        const auto wrap = [watch](std::unique_ptr<Stimulator> twin, const OpenContext& context) {
            auto watched = std::make_unique<WatchedStimulator>(std::move(twin), watch);
            if (watch->onOpen) watch->onOpen(context);
            return watched;
        };
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(std::make_unique<WrappedBench>(wrap, virtualTime));
        return Registry(std::move(drivers));
    };
}

}  // namespace tacto::test
