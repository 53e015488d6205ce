// StateWords.h - the sentence under the state's word: what is being done, by whom, and what to do next.
//
// Thread-safety: pure.
#pragma once

#include <QString>

#include "core/bench/Telemetry.h"

namespace tacto::gui {

/// "A train every 500 ms, set by hand. Space stops." `protocol` is the name of the one that has the bench; empty: a
/// person has it. What was commanded decides, not what was asked last. `refused`: the last train was, by a limit.
[[nodiscard]] QString stateWords(const Telemetry& telemetry, const QString& protocol, bool refused = false);

/// "stopped with Esc" of "operator (Esc)", as the bench keeps it; any other reason as it is.
[[nodiscard]] QString reasonWords(const QString& reason);

/// Checking, armed, delivering or paused: there is something to disarm.
[[nodiscard]] bool isOn(InterlockState state) noexcept;

}  // namespace tacto::gui
