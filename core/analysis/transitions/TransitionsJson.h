// TransitionsJson.h - steps and movements as JSON for scripts, and the result of a run. NaN is null.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/analysis/transitions/CapturedChange.h"
#include "core/analysis/transitions/ComputedTransitions.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// Writes the row that bench.step() or bench.traverse() returns.
[[nodiscard]] nlohmann::json toJson(const CapturedChange& change);

/// The result of a run, also before it ends.
struct TransitionsFound {
    ComputedTransitions computed = {};
    std::vector<CapturedChange> steps = {};  ///< steps with a judged latency
    std::vector<CapturedChange> jumps = {};
    std::vector<CapturedChange> movements = {};
    std::optional<LatencyJudgement> latency = {};  ///< empty until a step was captured, as is `changes`
    std::optional<ChangeJudgement> changes = {};
    std::optional<Verdict> verdict = {};
    std::vector<std::string> reasons = {};
};

[[nodiscard]] nlohmann::json toJson(const TransitionsFound& found);
/// Describes how the result of a run is judged and shown.
[[nodiscard]] ResultTraits transitionsKind();

}  // namespace tacto
