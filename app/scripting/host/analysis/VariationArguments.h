// VariationArguments.h - what a script asks of a prediction, read into its options.
//
// Thread-safety: the script's thread.
#pragma once

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptSession.h"
#include "core/analysis/variation/Variation.h"

namespace tacto::host::analysis {

[[nodiscard]] Drive variationSourceFrom(const Arguments& arguments);

/// Profile, limits and, where it drives as asked, the stimulator are the bench's, the seed is the run's. Errors:
/// InvalidArgument for thresholds that are not in order.
[[nodiscard]] Result<VariationOptions> variationOptionsFrom(ScriptSession& session, const Arguments& arguments);

}  // namespace tacto::host::analysis
