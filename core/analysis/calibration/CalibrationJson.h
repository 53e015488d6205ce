// CalibrationJson.h - writes calibrations and uncertainty budgets as JSON in the format of the command-line contract.
// Absent values (NaN, infinite degrees of freedom) are null.
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

[[nodiscard]] nlohmann::json toJson(const Calibration& found);
[[nodiscard]] nlohmann::json toJson(const UncertaintyBudget& budget);
/// The expanded uncertainty and the budget are those at the largest command.
[[nodiscard]] nlohmann::json toJson(const JudgedCalibration& judged);
[[nodiscard]] nlohmann::json toJson(const CalibrationCheck& check);
[[nodiscard]] nlohmann::json toJson(const KeptCalibration& kept);
/// Returns the keys of a kept calibration.
[[nodiscard]] std::vector<std::string> keptMembers();

// The table that `analyze calibration` reads.

/// Reads the CSV columns `commanded` and `measured` and, if present, `direction` (up, down or empty) and `u` (standard
/// uncertainty), in any order and with other columns between; names are trimmed. An empty or nan measured value means
/// not measured; an empty or nan `u` means not stated. Errors: NotFound, Io; ParseError naming file, line and what was
/// expected.
[[nodiscard]] Result<std::vector<CalibrationReading>> readCalibrationReadings(const std::filesystem::path& path);
/// Reads the same table from text; `name` replaces the file name in messages.
[[nodiscard]] Result<std::vector<CalibrationReading>> parseCalibrationReadings(std::string_view text,
                                                                               std::string_view name);

/// Describes how a stimulator calibration, or the check of a stored one, is judged and shown.
[[nodiscard]] ResultTraits stimulatorCalibrationKind();
[[nodiscard]] const ResultRecord<Calibration>& calibrationRecord();
/// Returns the keys of a judged calibration.
[[nodiscard]] std::vector<std::string> judgedMembers();

}  // namespace tacto
