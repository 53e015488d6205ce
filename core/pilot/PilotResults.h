// PilotResults.h - the contents and the display of the results of sessions with a participant. The study makes the
// reports of these results.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/analysis/psychophysics/AscendingLimits.h"
#include "core/analysis/psychophysics/LevelGrid.h"
#include "core/analysis/psychophysics/StrengthComparison.h"
#include "core/analysis/psychophysics/TwoIntervalTrials.h"
#include "core/analysis/statistics/Estimate.h"
#include "core/pilot/PilotSettings.h"
#include "core/results/ResultKind.h"
#include "core/study/StudySettings.h"

namespace tacto {

struct DetectionFound {
    DetectionMethod method = DetectionMethod::Quest;
    Estimate estimate = {};
    bool atEdge = false;  ///< the estimate lies at the edge of the range considered, or anywhere beyond
    std::vector<AnsweredTwoIntervalTrial> trials = {};
    IntervalShares shares = {};
};

/// Results of the steps before the identification.
struct ThresholdsFound {
    AscendingResult limits = {};
    std::optional<DetectionFound> detection = {};
    nlohmann::json range = {};  ///< the range as its row states it; null before it was measured
    std::optional<StrengthComparisonResult> compared = {};
};

/// Levels are in `unit`, and their keys name the unit.
[[nodiscard]] nlohmann::json thresholdsJson(const ThresholdsFound& found, LevelUnit unit);

[[nodiscard]] nlohmann::json presentedJson(const std::vector<PresentedCondition>& presented, LevelUnit unit);

[[nodiscard]] ResultTraits pilotThresholdsKind();
[[nodiscard]] ResultTraits pilotIdentificationKind();

}  // namespace tacto
