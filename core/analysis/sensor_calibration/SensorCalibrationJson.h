// SensorCalibrationJson.h - writes the sensor calibration as JSON in the command-line contract, and the readings for
// scripts. Absent (NaN) and infinite values are null.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/sensor_calibration/SensorCalibration.h"
#include "core/analysis/sensor_calibration/SensorReading.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// {"surfaces": [{"name","ra_um","rz_um","slides","h","h_abs","v","v_static","v_dynamic","R" (mean),"R_sd",
///  "R_expanded_uncertainty" (of one slide),"force_n"}],
///  "d_prime": {"h","v","R": {"value","low","high","told_apart"}|null, "all": {"h","h_abs","v_static","v_dynamic"}},
///  "uncertainty_R": {a profile's "uncertainty", "smooth","middle","rough": U at R 0, 0.5 and 1}|null,
///  "spearman": {"value","low","high","n","ties","note"}|null, "accepted","verdict" ("pass"|"fail"),"reasons",
///  "warnings","roughness" (a profile's section)}; "h" and "v" are the variants that the settings choose.
[[nodiscard]] nlohmann::json toJson(const SensorCalibration& found);
/// {"force": {"scale","scale_expanded_uncertainty","offset","offset_expanded_uncertainty",
/// "gain","residual_max_pct_fs", "repeatability_pct_fs","hysteresis_pct_fs","levels","readings","warnings", ...}, as
/// for Calibration, with "unit", "taxels": [{"taxel","unit","scale","offset_pa", ...}]}. A scale that is not known is
/// null, with its reason.
[[nodiscard]] nlohmann::json toJson(const FingertipScales& scales);

// Readings for scripts and for the run's results; the functions below list the keys of some.

[[nodiscard]] nlohmann::json toJson(const FingertipRest& rest);
[[nodiscard]] nlohmann::json toJson(const Slid& slide);
[[nodiscard]] nlohmann::json toJson(const WeightReading& reading);
[[nodiscard]] nlohmann::json toJson(const Weighed& weighed);
[[nodiscard]] nlohmann::json toJson(const KnownWeight& known);
[[nodiscard]] std::vector<std::string> restMembers();
[[nodiscard]] std::vector<std::string> weightMembers();

/// Describes how a fingertip's calibration is judged and shown.
[[nodiscard]] ResultTraits sensorCalibrationKind();

}  // namespace tacto
