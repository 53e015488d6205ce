// FirstOutput.h - the first output after the bench is armed: named in the arm dialog and drawn by the oscilloscope
// view.
#pragma once

#include <optional>

#include "app/gui/controller/BenchController.h"
#include "core/encoding/Encoder.h"

namespace tacto::gui {

/// Returns the drive ordered by hand while it drives; until armed, the bench's telemetry covers only the fingertip.
[[nodiscard]] std::optional<DriveCommand> orderedByHand(const BenchController& controller, const Telemetry& telemetry);

/// Returns the first command of the drive by hand. Nothing if the hand does not drive, or if nothing can be delivered.
[[nodiscard]] std::optional<Command> firstByHand(const BenchController& controller, const Telemetry& telemetry);

/// Returns the first command of "By hand", whatever drives now. Nothing if nothing can be delivered.
[[nodiscard]] std::optional<Command> wouldByHand(const BenchController& controller);

/// A train that has not been delivered yet.
struct ComingTrain {
    PulseTrain train;                     ///< in volts
    std::optional<double> impedance_ohm;  ///< |Z| of the load; nothing: not measured
    bool asked = false;                   ///< the operator asked for it; otherwise it comes once "By hand" is chosen
    bool operator==(const ComingTrain&) const = default;
};

/// Returns the train of firstByHand(), or of wouldByHand() while nothing drives, if the output is armed but has not
/// delivered a train. Nothing in any other state, for a massager, and during a run.
[[nodiscard]] std::optional<ComingTrain> comingTrain(const BenchController& controller, const Telemetry& telemetry);

}  // namespace tacto::gui
