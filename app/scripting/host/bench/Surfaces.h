// Surfaces.h - a surface under the finger: what every function that slides one takes and does.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include <string>

#include "core/base/Result.h"

namespace tacto {
class Arguments;
class ScriptSession;
}  // namespace tacto

namespace tacto::host::bench {

struct Sliding {
    std::string material;
    double speed_mm_s = 50;
    double force_n = 1;
};

/// A slide over `material` with the options speed_mm_s and force_n; `usualForce_n` where the function has no default.
[[nodiscard]] Sliding slidingOver(std::string material, const Arguments& arguments, double usualForce_n = 1);

/// Puts a surface under the finger, or asks for it (question surface-MATERIAL). Errors: InvalidArgument for an unknown
/// surface; NotFound without an answer; Stopped.
[[nodiscard]] Result<void> slide(ScriptSession& session, const Sliding& sliding);

}  // namespace tacto::host::bench
