// StateWords.h - the state in words: what is being done, by whom, and what to do next; and the exposure as displays
// show it: the gate's present values, without those from before the output went off.
//
// Thread-safety: pure functions.
#pragma once

#include <QString>
#include <vector>

#include "core/bench/Telemetry.h"

namespace tacto::gui {

/// "A train every 500 ms, set by hand. Space stops." `protocol`: the protocol that uses the bench; empty: a person
/// does. The text shows what was commanded, not the latest request. `refused`: a limit refused the last train.
[[nodiscard]] QString stateWords(const Telemetry& telemetry, const QString& protocol, bool refused = false);

/// Returns "stopped with Esc" for "operator (Esc)", as the bench stores it; other reasons unchanged.
[[nodiscard]] QString reasonWords(const QString& reason);

/// True for checking, armed, delivering and paused: the states that can be disarmed.
[[nodiscard]] bool isOn(InterlockState state) noexcept;

/// True if no train comes before the operator arms: disconnected, disarmed, faulted.
[[nodiscard]] bool outputIsOff(InterlockState state);

/// Returns the rows of `telemetry`. While the output is off, quantities of single pulses and trains are 0, because none
/// is delivered; quantities over a time window still include the trains in that window, as in the gate. Unevaluated
/// rows stay unevaluated. No rows while the output is off and nothing was judged yet: unknown is not 0.
[[nodiscard]] std::vector<ExposureRow> exposureNow(const Telemetry& telemetry);

}  // namespace tacto::gui
