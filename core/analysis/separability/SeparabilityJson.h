// SeparabilityJson.h - a judged separability in the shape of the command line's contract (cli.md).
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/separability/Separability.h"

namespace tacto {

/// {"conditions","pairs","confusion","accuracy","verdict","reasons", ...}
[[nodiscard]] nlohmann::json toJson(const Separability& found);

}  // namespace tacto
