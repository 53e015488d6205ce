// TransitionsJson.h - steps and movements as JSON for scripts, and their judgements. NaN is null.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/transitions/CapturedChange.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// Writes the row that bench.step() or bench.traverse() returns.
[[nodiscard]] nlohmann::json toJson(const CapturedChange& change);

[[nodiscard]] nlohmann::json toJson(const LatencyJudgement& judgement);
[[nodiscard]] nlohmann::json toJson(const ChangeJudgement& judgement);
/// Describes how results with both members, `changes` and `latency`, are judged and shown.
[[nodiscard]] ResultTraits transitionsKind();

}  // namespace tacto
