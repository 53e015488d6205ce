// Unpluggable.h - the simulated bench with a stimulator that a test can unplug at any moment, however slow the machine
// is.
//
// Thread-safety: Plug from any thread; the other classes like Driver and Stimulator.
#pragma once

#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "drivers/replay/ReplayDrivers.h"
#include "tests/support/WrappedTwin.h"

namespace tacto::test {

using Plug = std::shared_ptr<std::atomic<bool>>;  ///< true: plugged in

class UnpluggableStimulator final : public WrappedStimulator {
public:
    UnpluggableStimulator(std::unique_ptr<Stimulator> twin, Plug plug, std::string says)
        : WrappedStimulator(std::move(twin)), plug_(std::move(plug)), says_(std::move(says)) {}
    Result<void> deliver(ApprovedTrain&& train) override {
        if (!*plug_) return out();
        return WrappedStimulator::deliver(std::move(train));
    }
    Result<StimulatorStatus> status() override {
        if (!*plug_) return out();
        return WrappedStimulator::status();
    }
    Result<void> keepAlive() override {
        if (!*plug_) return out();
        return WrappedStimulator::keepAlive();
    }

private:
    [[nodiscard]] tl::unexpected<Error> out() const { return fail(ErrorCode::Device, "{}", says_); }

    const Plug plug_;
    const std::string says_;
};

/// Like simulatedRegistry(); an unplugged stimulator fails with the text `says`.
[[nodiscard]] inline Registry unpluggableRegistry(const Plug& plug,
                                                  const std::string& says = "the simulated stimulator is unplugged") {
    std::vector<std::unique_ptr<Driver>> drivers;
    drivers.push_back(
        std::make_unique<WrappedBench>([plug, says](std::unique_ptr<Stimulator> twin, const OpenContext&) {
            return std::make_unique<UnpluggableStimulator>(std::move(twin), plug, says);
        }));
    drivers.push_back(makeRecordingDriver());
    drivers.push_back(makeCaptureDriver());
    return Registry(std::move(drivers));
}

}  // namespace tacto::test
