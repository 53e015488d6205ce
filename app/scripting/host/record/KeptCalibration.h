// KeptCalibration.h - keeping a calibration, for record.calibration() and the calibration of a stimulator.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/scripting/engine/ScriptSession.h"
#include "core/calibration/CalibrationStore.h"

namespace tacto::host::record {

struct Validity {
    int days = 365;
    std::string scopeDue{};  ///< the day on which the oscilloscope's own calibration is due; empty: not stated
};

/// As record.calibration(). `found`: { amplitude, interval, width, gap }, of which the numbers of their calibrations
/// alone count.
[[nodiscard]] Result<nlohmann::json> keepCalibration(ScriptSession& session, const nlohmann::json& found,
                                                     const Validity& validity);

}  // namespace tacto::host::record
