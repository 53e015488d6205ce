// GivenReadings.h - the readings of a calibration as a script hands them over: rows { commanded, measured, direction }.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "core/analysis/calibration/Calibration.h"
#include "core/base/Result.h"

namespace tacto::host::analysis {

/// A reading without `measured` was not measured; one without `direction` has none. `function` begins every message.
/// Errors: InvalidArgument for a row that is not a reading, and for a direction other than up, down and "".
[[nodiscard]] Result<std::vector<CalibrationReading>> readingsGiven(std::string_view function,
                                                                    const nlohmann::json& rows);

/// The direction of a row; none where it has none. Errors: as readingsGiven().
[[nodiscard]] Result<SweepDirection> directionGiven(std::string_view function, const nlohmann::json& row);

/// "analysis.calibration: direction is 3, "up", "down" or "" is expected".
[[nodiscard]] tl::unexpected<Error> otherThanExpected(std::string_view function, std::string_view name,
                                                      const nlohmann::json& value, std::string_view accepted);

}  // namespace tacto::host::analysis
