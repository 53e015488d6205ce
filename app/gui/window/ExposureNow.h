// ExposureNow.h - the gate's exposure as displays show it: what it holds now, and not what it was before the output
// went off.
//
// Thread-safety: pure.
#pragma once

#include <vector>

#include "core/bench/Telemetry.h"

namespace tacto::gui {

/// Whether no train is delivered, and none follows before the operator arms: disconnected, disarmed, faulted.
[[nodiscard]] bool outputIsOff(InterlockState state);

/// The rows of `telemetry`. While the output is off a quantity of single pulses and trains is 0, for none is delivered;
/// one over a window still has the trains of that window in it, as the gate counts them. What was not evaluated stays
/// so. None while the output is off and nothing has been judged against a limit yet: unknown is not 0.
[[nodiscard]] std::vector<ExposureRow> exposureNow(const Telemetry& telemetry);

}  // namespace tacto::gui
