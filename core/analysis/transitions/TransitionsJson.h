// TransitionsJson.h - steps and movements as scripts carry them from the bench to their analysis, and what they
// were judged to be. NaN is null.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/transitions/CapturedChange.h"
#include "core/base/Result.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// A row that a script hands back, with the name that it gave. Null and a missing key: not measured. Keys that are not
/// known are the script's own. Errors: InvalidArgument for a row without a name and for values of another type.
[[nodiscard]] Result<CapturedChange> capturedChangeFrom(const nlohmann::json& row);
/// The row that bench.step() or bench.traverse() returns.
[[nodiscard]] nlohmann::json toJson(const CapturedChange& change);

[[nodiscard]] nlohmann::json toJson(const LatencyJudgement& judgement);
[[nodiscard]] nlohmann::json toJson(const ChangeJudgement& judgement);
/// How a protocol's results are judged and shown that has both, as `changes` and `latency`.
[[nodiscard]] ResultTraits transitionsKind();

}  // namespace tacto
