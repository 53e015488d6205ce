// EncodingChange.h - what a run changes of the encoding, for bench.setEncoding() and the levels of a calibration.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include <nlohmann/json.hpp>

#include "core/bench/Bench.h"

namespace tacto::host::bench {

/// Sets the members of the profile's encoding section that `changes` has; the others stay. Errors: InvalidArgument for
/// an unknown key or a value outside its range; as Bench::setProfile().
[[nodiscard]] Result<void> changeEncoding(Bench& bench, const nlohmann::json& changes);

}  // namespace tacto::host::bench
