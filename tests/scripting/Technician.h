// Technician.h - makes a simulated bench look like a real one to a protocol: a stimulator that says it is real, and a
// technician who fits the loads and does what is asked.
//
// Thread-safety: as an Operator: called on the script's thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/scripting/engine/Operator.h"
#include "core/devices/DeviceSet.h"
#include "tests/support/RealLookingStimulator.h"

namespace tacto::test {

/// Fits and changes the loads as requested, and confirms everything else; `asked` keeps every question.
class Technician final : public Operator {
public:
    explicit Technician(std::shared_ptr<LoadFitter> hand) : hand_(std::move(hand)) {}
    Result<nlohmann::json> ask(const OperatorQuestion& question) override;
    void cancel() noexcept override {}

    std::vector<OperatorQuestion> asked;

private:
    std::shared_ptr<LoadFitter> hand_;
};

/// Makes the devices of a simulated bench look real.
[[nodiscard]] inline std::unique_ptr<Technician> lookReal(DeviceSet& devices) {
    auto technician = std::make_unique<Technician>(std::move(devices.load));
    devices.surface.reset();
    devices.stimulator = std::make_unique<RealLookingStimulator>(std::move(devices.stimulator));
    return technician;
}

}  // namespace tacto::test
