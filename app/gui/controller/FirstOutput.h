// FirstOutput.h - the output that follows first once the bench is armed: the arm dialog names it, the oscilloscope
// draws it.
#pragma once

#include <optional>

#include "app/gui/controller/BenchController.h"
#include "core/encoding/Encoder.h"

namespace tacto::gui {

/// What was ordered by hand, while that drives: until the output is armed the bench tells about the fingertip alone.
[[nodiscard]] std::optional<DriveCommand> orderedByHand(const BenchController& controller, const Telemetry& telemetry);

/// What the drive by hand asks for first. Nothing while something else drives or nothing does, and where nothing can be
/// delivered.
[[nodiscard]] std::optional<Command> firstByHand(const BenchController& controller, const Telemetry& telemetry);

/// What "By hand" would ask for first, whatever drives. Nothing where nothing can be delivered.
[[nodiscard]] std::optional<Command> wouldByHand(const BenchController& controller);

/// A train that was not delivered yet.
struct ComingTrain {
    PulseTrain train;                     ///< in volts
    std::optional<double> impedance_ohm;  ///< |Z| that it meets; nothing: not measured
    bool asked = false;                   ///< it comes next; else it would, once "By hand" is chosen
    bool operator==(const ComingTrain&) const = default;
};

/// The train of firstByHand(), or of wouldByHand() while nothing drives, while the output is armed and has delivered
/// none. Nothing in any other state, for a massager, and where a run has the bench.
[[nodiscard]] std::optional<ComingTrain> comingTrain(const BenchController& controller, const Telemetry& telemetry);

}  // namespace tacto::gui
