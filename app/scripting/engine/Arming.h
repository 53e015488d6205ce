// Arming.h - arming by a script: the operator confirms exactly what will be armed (hazard H12).
#pragma once

#include <string>

#include "app/scripting/engine/ScriptSession.h"

namespace tacto {

/// The key of --set that answers the arming question. The confirmed text is Bench::armingText().
inline constexpr const char* kConfirmArming = "confirm-arming";

/// Asks the operator to confirm if the output is real. Does not ask again for the same text in this run until a load
/// changes. A simulated output needs no confirmation. Errors: as parseLoad() and Operator::ask().
[[nodiscard]] Result<ArmRequest> confirmedArming(ScriptSession& session, const std::string& load);
/// Asks as confirmedArming() does, then arms. Errors: as confirmedArming() and Bench::arm().
[[nodiscard]] Result<void> armConfirmed(ScriptSession& session, const std::string& load);

}  // namespace tacto
