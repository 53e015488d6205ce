// FirstOutput.h - the output that follows first once the bench is armed: the arm dialog names it, the oscilloscope
// draws it.
#pragma once

#include <optional>

#include "app/gui/controller/BenchController.h"
#include "core/encoding/Encoder.h"

namespace tacto::gui {

/// The drive ordered by hand, while it drives: until the output is armed the bench tells about the fingertip alone.
[[nodiscard]] std::optional<DriveCommand> orderedByHand(const BenchController& controller, const Telemetry& telemetry);

/// The first command of the drive by hand. Nothing while something else drives or nothing does, and where nothing can
/// be delivered.
[[nodiscard]] std::optional<Command> firstByHand(const BenchController& controller, const Telemetry& telemetry);

/// What "By hand" would ask for first, no matter what drives now. Nothing where nothing can be delivered.
[[nodiscard]] std::optional<Command> wouldByHand(const BenchController& controller);

/// A train that was not delivered yet.
struct ComingTrain {
    PulseTrain train;                     ///< in volts
    std::optional<double> impedance_ohm;  ///< |Z| that it meets; nothing: not measured
    bool asked = false;                   ///< the operator asked for this next; else it comes once "By hand" is chosen
    bool operator==(const ComingTrain&) const = default;
};

/// The train of firstByHand(), or of wouldByHand() while nothing drives, while the output is armed and has not yet
/// delivered one. Nothing in any other state, for a massager, and where a run has the bench.
[[nodiscard]] std::optional<ComingTrain> comingTrain(const BenchController& controller, const Telemetry& telemetry);

}  // namespace tacto::gui
