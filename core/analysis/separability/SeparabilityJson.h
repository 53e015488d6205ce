// SeparabilityJson.h - a judged separability in the shape of the command line's contract (cli.md).
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/separability/Separability.h"
#include "core/base/Result.h"

namespace tacto {

/// A trial as measure.train() measured it, with its condition. Null and a missing key: not measured, or for an
/// uncertainty not stated. Errors: InvalidArgument for a row without a condition and for values of another type.
[[nodiscard]] Result<SeparabilityTrial> separabilityTrialFrom(const nlohmann::json& row);
/// {"condition","amplitude_v","interval_s","amplitude_u_v","interval_u_s","time_base_u",
/// "amplitude_gain_u"}
[[nodiscard]] nlohmann::json toJson(const SeparabilityTrial& trial);

/// {"conditions","pairs","confusion","accuracy","verdict","reasons", ...}
[[nodiscard]] nlohmann::json toJson(const Separability& found);

}  // namespace tacto
