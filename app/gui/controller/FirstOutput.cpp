#include "app/gui/controller/FirstOutput.h"

#include <cmath>

namespace tacto::gui {

namespace {

std::optional<Command> commandOf(const BenchController& controller, const DriveCommand& drive) {
    const auto first = Encoder(controller.profile().encoding).encode(drive.roughness, drive.pressure);
    return first ? std::optional(*first) : std::nullopt;
}

}  // namespace

std::optional<Command> wouldByHand(const BenchController& controller) {
    return commandOf(controller, controller.hand());
}

std::optional<DriveCommand> orderedByHand(const BenchController& controller, const Telemetry& telemetry) {
    const auto& ordered = controller.lastDrive();
    if (telemetry.driving != DriveSource::Manual || ordered.source != DriveSource::Manual) return std::nullopt;
    return ordered;
}

std::optional<Command> firstByHand(const BenchController& controller, const Telemetry& telemetry) {
    const auto ordered = orderedByHand(controller, telemetry);
    return ordered ? commandOf(controller, *ordered) : std::nullopt;
}

std::optional<ComingTrain> comingTrain(const BenchController& controller, const Telemetry& telemetry) {
    const auto open = controller.open();
    if (controller.activity() != Activity::Live || !open || !open->source) return std::nullopt;
    if (telemetry.state != InterlockState::Armed) return std::nullopt;  // after the first train: Delivering
    const bool off = telemetry.driving == DriveSource::Off;
    const auto first = off ? wouldByHand(controller) : firstByHand(controller, telemetry);
    if (!first) return std::nullopt;
    ComingTrain coming{voltageTrain(controller.profile().encoding, first->amplitude), std::nullopt, !off};
    if (std::isfinite(telemetry.impedance_ohm) && telemetry.impedance_ohm > 0)
        coming.impedance_ohm = telemetry.impedance_ohm;
    return coming;
}

}  // namespace tacto::gui
