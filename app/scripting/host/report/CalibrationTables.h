// CalibrationTables.h - a stimulator's calibration as the tables and sentences of its report.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tacto::host::report {

/// "Amplitude", "Phase width" of "amplitude", "width".
[[nodiscard]] std::string titleOfQuantity(const std::string& quantity);

// Items of a report, each { kind, caption, rows, columns } or { kind, text }.

/// Report items for the result of analysis.calibration(): levels, budget, coverage, marked readings.
[[nodiscard]] nlohmann::json calibrationItems(const nlohmann::json& found);

}  // namespace tacto::host::report
