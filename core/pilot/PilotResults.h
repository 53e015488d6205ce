// PilotResults.h - what the results of sessions with a participant hold, and how they are shown. Their reports are the
// study's.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/analysis/psychophysics/AscendingLimits.h"
#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/analysis/psychophysics/StrengthComparison.h"
#include "core/analysis/psychophysics/TwoIntervalTrials.h"
#include "core/analysis/statistics/Estimate.h"
#include "core/results/ResultKind.h"
#include "core/study/StudySettings.h"

namespace tacto {

struct DetectionFound {
    DetectionMethod method = DetectionMethod::Quest;
    Estimate estimate = {};
    bool atEdge = false;  ///< of what was considered: it may lie anywhere beyond
    std::vector<AnsweredTwoIntervalTrial> trials = {};
    IntervalShares shares = {};
};

/// What the steps before the identification came to.
struct ThresholdsFound {
    AscendingResult limits = {};
    std::optional<DetectionFound> detection = {};
    nlohmann::json range = {};  ///< as its row says it; null before it was measured
    std::optional<StrengthComparisonResult> compared = {};
};

/// Levels are those of `unit`, and their keys say so.
[[nodiscard]] nlohmann::json thresholdsJson(const ThresholdsFound& found, LevelUnit unit);

[[nodiscard]] ResultTraits pilotThresholdsKind();
[[nodiscard]] ResultTraits pilotIdentificationKind();

}  // namespace tacto
