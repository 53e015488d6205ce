// CalibrationFigure.h - a calibration as a figure of the report.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>

namespace tacto::host::plot {

/// `view`: "measured" against commanded, or "errors". `found`: from analysis.calibration().
[[nodiscard]] inline nlohmann::json calibrationFigure(const nlohmann::json& found, const char* view) {
    nlohmann::json out = {{"type", "calibration"}, {"view", view}};
    for (const char* key : {"quantity", "unit", "gain", "offset", "levels", "readings", "full_scale"})
        out[key] = found.value(key, nlohmann::json());
    return out;
}

}  // namespace tacto::host::plot
