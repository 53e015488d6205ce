// FingertipItems.h - a fingertip's calibration as the tables, figures and sentences of its report.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>

namespace tacto::host::report {

/// What the references of a fingertip's scales are known to, % and cm²; 0: not known.
struct FingertipReferences {
    double weight_pct = 0, gravity_pct = 0, area_cm2 = 0, area_pct = 0;
};

// Items of a report, each { kind, caption, rows, columns }, { kind, caption, figure } or { kind, text }.

/// Report items for the result of analysis.fingertipScales().
[[nodiscard]] nlohmann::json fingertipScaleItems(const nlohmann::json& scales, const FingertipReferences& known);
/// Report items for the result of analysis.sensorCalibration(). `simulated`: every device was simulated.
[[nodiscard]] nlohmann::json sensorCalibrationItems(const nlohmann::json& found, bool simulated);
/// Report items for the result of bench.measureRest().
[[nodiscard]] nlohmann::json fingertipRestItems(const nlohmann::json& rest, bool hasTaxels);
/// What a sensor calibration has read so far, `weights` and `slides` of its results, as tables.
[[nodiscard]] nlohmann::json fingertipTables(const nlohmann::json& results);
[[nodiscard]] nlohmann::json slidesTable(const nlohmann::json& slides);

}  // namespace tacto::host::report
