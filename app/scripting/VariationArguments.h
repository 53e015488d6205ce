// VariationArguments.h - what a script asks of a prediction, read into its options.
//
// Thread-safety: the script's thread.
#pragma once

#include <initializer_list>

#include "app/scripting/Arguments.h"
#include "app/scripting/ScriptSession.h"
#include "core/analysis/Variation.h"

namespace tacto {

/// A member of an options object that is a number.
struct NumberOption {
    const char* key;
    double* target;  ///< keeps its value where the member is absent
    NumberRange range;
};
[[nodiscard]] Result<void> readNumbers(const Arguments& arguments, const nlohmann::json& options,
                                       std::initializer_list<NumberOption> wanted);

/// "current" (where it is left out) or "voltage".
[[nodiscard]] Result<Drive> variationSourceFrom(const Arguments& arguments, const nlohmann::json& options);

/// Profile, limits and, where it drives as asked, the stimulator are the bench's, the seed is the run's. Errors:
/// InvalidArgument naming the member, its value and what is accepted.
[[nodiscard]] Result<VariationOptions> variationOptionsFrom(ScriptSession& session, const Arguments& arguments,
                                                            const nlohmann::json& given);

}  // namespace tacto
