// KeptCalibration.h - keeps a calibration, for record.calibration() and for the calibration of a stimulator.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/scripting/engine/ScriptSession.h"
#include "core/calibration/CalibrationStore.h"

namespace tacto::host::record {

struct Validity {
    int days = 365;
    std::string scopeDue{};  ///< date on which the oscilloscope's own calibration is due; empty: not stated
};

/// Keeps a calibration as record.calibration() does. `found`: { amplitude, interval, width, gap }; only the calibration
/// number in each is used.
[[nodiscard]] Result<nlohmann::json> keepCalibration(ScriptSession& session, const nlohmann::json& found,
                                                     const Validity& validity);

}  // namespace tacto::host::record
