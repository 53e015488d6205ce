// StateWords.h - the state in words: what is being done, by whom, and what to do next; and the gate's exposure as
// displays show it: what it holds now, and not what it was before the output went off.
//
// Thread-safety: pure.
#pragma once

#include <QString>
#include <vector>

#include "core/bench/Telemetry.h"

namespace tacto::gui {

/// "A train every 500 ms, set by hand. Space stops." `protocol` names the one that has the bench; empty: a person has
/// it. The sentence follows what was commanded, not what was last asked. `refused`: a limit refused the last train.
[[nodiscard]] QString stateWords(const Telemetry& telemetry, const QString& protocol, bool refused = false);

/// "stopped with Esc" of "operator (Esc)", as the bench keeps it; any other reason as it is.
[[nodiscard]] QString reasonWords(const QString& reason);

/// Checking, armed, delivering or paused: there is something to disarm.
[[nodiscard]] bool isOn(InterlockState state) noexcept;

/// Whether no train is delivered, and none follows before the operator arms: disconnected, disarmed, faulted.
[[nodiscard]] bool outputIsOff(InterlockState state);

/// The rows of `telemetry`. While the output is off, a quantity of single pulses and trains is 0, as none is delivered;
/// a quantity over a window still includes the trains of that window, as the gate counts them. Unevaluated rows stay
/// so. There are no rows while the output is off and nothing has been judged against a limit yet: unknown is not 0.
[[nodiscard]] std::vector<ExposureRow> exposureNow(const Telemetry& telemetry);

}  // namespace tacto::gui
