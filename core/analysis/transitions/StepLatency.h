// StepLatency.h - the latency of steps, name by name: what was measured against what the scheduler's design says.
//
// Thread-safety: pure functions.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/analysis/statistics/Verdict.h"
#include "core/analysis/transitions/CapturedChange.h"
#include "core/base/Statistics.h"

namespace tacto {

struct LatencyGroup {
    std::string name;
    std::size_t steps = 0;
    Statistics latency_s, designed_s, difference_s, trains, designedTrains;
    Verdict verdict = Verdict::Indeterminate;
};

struct LatencyJudgement {
    double tolerance_s = 0;
    std::vector<LatencyGroup> groups;
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons;
};

/// `names` must all be there for a pass. A step that was not measured makes its group indeterminate; one that is
/// further from the design than `tolerance_s`, or takes more trains, makes it a fail.
[[nodiscard]] LatencyJudgement judgeLatency(std::span<const CapturedChange> steps,
                                            const std::vector<std::string>& names, double tolerance_s);

}  // namespace tacto
