// CalibrationJson.h - calibrations and uncertainty budgets in the shapes of the command line's contract. Absent values
// (NaN, infinite degrees of freedom) are null.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/calibration/CalibrationVerdict.h"

namespace tacto {

/// {"gain","offset","residual_max_pct_fs","repeatability_pct_fs","hysteresis_pct_fs","full_scale", ..., "levels",
/// "readings","warnings"}
[[nodiscard]] nlohmann::json toJson(const Calibration& found);
/// {"rows":[{"name","distribution","value","divisor","sensitivity","contribution","degrees_of_freedom"}],
/// "combined","degrees_of_freedom","coverage_factor","expanded_uncertainty","method"}
[[nodiscard]] nlohmann::json toJson(const UncertaintyBudget& budget);
/// What toJson(Calibration) says, each level with error, expanded_uncertainty, tolerance and verdict; and
/// {"expanded_uncertainty" (at the largest command), "gain_expanded_uncertainty", "offset_expanded_uncertainty",
/// "budget" (at the largest command), "tolerance_pct","verdict","reasons"}; k of each as "..._coverage_factor".
[[nodiscard]] nlohmann::json toJson(const JudgedCalibration& judged);

}  // namespace tacto
