// SensorCalibrationJson.h - writes the sensor calibration as JSON in the command-line contract, and the readings for
// scripts. Absent (NaN) and infinite values are null.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/sensor_calibration/SensorCalibration.h"
#include "core/analysis/sensor_calibration/SensorReading.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// "h" and "v" are the variants that the settings choose; the R of a surface is a mean, its U that of one slide, and U
/// of R is given at R 0, 0.5 and 1.
[[nodiscard]] nlohmann::json toJson(const SensorCalibration& found);
/// Writes a surface as it stands in the results before it is felt.
[[nodiscard]] nlohmann::json toJson(const SlidSurface& surface);
/// A scale that is not known is null, with its reason.
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
