// TransitionsJson.h - steps and movements as scripts are told of them, and what they were judged to be. NaN is null.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/transitions/CapturedChange.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// The row that bench.step() or bench.traverse() returns.
[[nodiscard]] nlohmann::json toJson(const CapturedChange& change);

[[nodiscard]] nlohmann::json toJson(const LatencyJudgement& judgement);
[[nodiscard]] nlohmann::json toJson(const ChangeJudgement& judgement);
/// How a protocol's results are judged and shown that has both, as `changes` and `latency`.
[[nodiscard]] ResultTraits transitionsKind();

}  // namespace tacto
