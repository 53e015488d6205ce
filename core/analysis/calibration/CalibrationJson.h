// CalibrationJson.h - calibrations and uncertainty budgets in the shapes of the command line's contract. Absent values
// (NaN, infinite degrees of freedom) are null.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "core/analysis/calibration/Calibration.h"
#include "core/analysis/calibration/CalibrationVerdict.h"
#include "core/base/Result.h"
#include "core/results/ResultRecord.h"

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

// The table that `analyze calibration` reads.

/// Readings from CSV columns `commanded`, `measured` and, where there are such, `direction` (up, down or empty) and `u`
/// (standard uncertainty), in any order among others; names are trimmed. An empty or nan measured value was not
/// measured; an empty or nan `u` is not stated.
/// Errors: NotFound, Io; ParseError naming file, line and what was expected.
[[nodiscard]] Result<std::vector<CalibrationReading>> readCalibrationReadings(const std::filesystem::path& path);
/// Reads them from text; `name` stands for the file in messages.
[[nodiscard]] Result<std::vector<CalibrationReading>> parseCalibrationReadings(std::string_view text,
                                                                               std::string_view name);

/// How a stimulator's calibration, or a check of one that is stored, is judged and shown.
[[nodiscard]] ResultTraits stimulatorCalibrationKind();
[[nodiscard]] const ResultRecord<Calibration>& calibrationRecord();

}  // namespace tacto
