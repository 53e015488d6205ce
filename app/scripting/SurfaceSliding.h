// SurfaceSliding.h - a surface under the finger: what every function that slides one takes and does.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/base/Result.h"

namespace tacto {

class Arguments;
class ScriptSession;

struct Sliding {
    std::string material;
    double speed_mm_s = 50;
    double force_n = 1;
};

/// Of the options material, speed_mm_s and force_n; `usual` for what is left out. Errors: InvalidArgument.
[[nodiscard]] Result<Sliding> slidingFrom(const Arguments& arguments, const nlohmann::json& options,
                                          const Sliding& usual);

/// Puts a surface under the finger, or asks for it (question surface-MATERIAL). Errors: InvalidArgument for an unknown
/// surface; NotFound without an answer; Stopped.
[[nodiscard]] Result<void> slide(ScriptSession& session, const Sliding& sliding);

}  // namespace tacto
