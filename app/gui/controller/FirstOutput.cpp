#include "app/gui/controller/FirstOutput.h"

#include <cmath>

namespace tacto::gui {

std::optional<Command> firstByHand(const BenchController& controller, const Telemetry& telemetry) {
    const auto& wanted = controller.lastDrive();
    if (telemetry.driving != DriveSource::Manual || wanted.source != DriveSource::Manual) return std::nullopt;
    const auto first = Encoder(controller.profile().encoding).encode(wanted.roughness, wanted.pressure);
    return first ? std::optional(*first) : std::nullopt;
}

std::optional<ComingTrain> comingTrain(const BenchController& controller, const Telemetry& telemetry) {
    const auto open = controller.open();
    if (controller.activity() != Activity::Live || !open || !open->source) return std::nullopt;
    if (telemetry.state != InterlockState::Armed) return std::nullopt;  // the first train makes it Delivering
    const auto first = firstByHand(controller, telemetry);
    if (!first) return std::nullopt;
    ComingTrain coming{voltageTrain(controller.profile().encoding, first->amplitude), std::nullopt};
    if (std::isfinite(telemetry.impedance_ohm) && telemetry.impedance_ohm > 0)
        coming.impedance_ohm = telemetry.impedance_ohm;
    return coming;
}

}  // namespace tacto::gui
