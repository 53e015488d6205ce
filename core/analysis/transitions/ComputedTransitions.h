// ComputedTransitions.h - the largest steps that an encoding makes from train to train, computed and judged: at most
// kWantedPerTrain just-noticeable differences are wanted (science.md section 4).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/analysis/statistics/Verdict.h"
#include "core/encoding/Transitions.h"
#include "core/results/ResultRecord.h"

namespace tacto {

struct ComputedTransitions {
    EncodingProfile encoding;
    TransitionSweep sweep;
    bool jumpsJudged = true;  ///< whether jumps between the corners of the plane were judged too
    TransitionReport report;
    TransitionMap map;
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons = {};  ///< one sentence for each step that is too large
};

/// Errors: as sweepTransitions().
[[nodiscard]] Result<ComputedTransitions> computeTransitions(const EncodingProfile& encoding,
                                                             const TransitionSweep& sweep, bool judgeJumps);

[[nodiscard]] nlohmann::json toJson(const ComputedTransitions& computed);

/// Describes the members, the largest steps as columns, and the table that shows them side by side.
[[nodiscard]] const ResultRecord<ComputedTransitions>& computedTransitionsRecord();

}  // namespace tacto
