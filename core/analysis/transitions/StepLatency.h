// StepLatency.h - the latency of steps, name by name: what was measured against what the scheduler's design says.
//
// Thread-safety: pure functions.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/analysis/statistics/Verdict.h"
#include "core/base/NaN.h"
#include "core/base/Statistics.h"

namespace tacto {

/// One step; NaN: not measured. The range of the design is what a measurement of it may find.
struct StepLatency {
    std::string name;
    double latency_s = kNaN;  ///< from the step to the train that carries it
    double designed_s = kNaN, designedLow_s = kNaN, designedHigh_s = kNaN;
    double trains = kNaN;  ///< until the step is complete
    double designedTrains = kNaN, designedTrainsHigh = kNaN;
};

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
[[nodiscard]] LatencyJudgement judgeLatency(std::span<const StepLatency> steps, const std::vector<std::string>& names,
                                            double tolerance_s);

}  // namespace tacto
