// TransitionsJson.h - steps and changes as scripts hand them over, and what they were judged to be. NaN is null.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/transitions/CapturedChange.h"
#include "core/analysis/transitions/StepLatency.h"

namespace tacto {

/// A row of bench.step(), with a name. What is absent or no number was not measured.
[[nodiscard]] StepLatency stepLatencyFrom(const nlohmann::json& row);
/// A row of bench.step() or bench.traverse(), with a name.
[[nodiscard]] CapturedChange capturedChangeFrom(const nlohmann::json& row);

[[nodiscard]] nlohmann::json toJson(const LatencyJudgement& judgement);
[[nodiscard]] nlohmann::json toJson(const ChangeJudgement& judgement);

}  // namespace tacto
