// Arming.h - what a script's arming takes: the operator's confirmation of exactly what would be armed (hazard H12).
#pragma once

#include <string>

#include "app/scripting/engine/ScriptSession.h"

namespace tacto {

/// The key of --set that answers the question. What it confirms is Bench::armingText().
inline constexpr const char* kConfirmArming = "confirm-arming";

/// Asks for the confirmation where the output is real, unless this run has it for the same text and no load was
/// changed since. A simulated output needs none. Errors: as parseLoad() and Operator::ask().
[[nodiscard]] Result<ArmRequest> confirmedArming(ScriptSession& session, const std::string& load);
/// Asks as confirmedArming() does, and arms. Errors: as confirmedArming() and Bench::arm().
[[nodiscard]] Result<void> armConfirmed(ScriptSession& session, const std::string& load);

}  // namespace tacto
