// Prediction.h - what a command would be and do on a load, and asking for it, for bench.predict(), bench.attempt() and
// the checks on loads.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/scripting/engine/ScriptSession.h"

namespace tacto::host::bench {

/// As bench.predict() returns it; nothing is delivered. `strength`: 0 the weakest amplitude to 1 the strongest, at the
/// shortest interval. Errors: InvalidArgument for a load that cannot be read; as Encoder::encode().
[[nodiscard]] Result<nlohmann::json> predictCommand(ScriptSession& session, const std::string& load, double strength);

struct Attempt {
    bool refused = false;
    bool delivered = false;
    std::string reason;  ///< of the refusal
};
/// Asks for one train of this command while armed; the drive is off again afterwards. Errors: when the run is stopped
/// or a device fails.
[[nodiscard]] Result<Attempt> attemptCommand(Bench& bench, double R, double P);

}  // namespace tacto::host::bench
