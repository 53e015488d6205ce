// CalibrationAsked.h - the calibration of one quantity from the run's readings, for analysis.calibration() and the
// calibration of a stimulator.
//
// Thread-safety: calls come from the script's thread.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/scripting/engine/ScriptSession.h"
#include "core/analysis/calibration/CalibrationVerdict.h"

namespace tacto::host::analysis {

struct CalibrationAsked {
    std::string quantity = "amplitude";
    double tolerance_pct = 2;  ///< of the command at each level
    CalibrationOptions fit;
    /// What the instrument states of itself comes from the readings; these may widen it.
    InstrumentErrors errors;
};

/// As analysis.calibration() returns it; `readings` as it takes them. Errors: InvalidArgument for a reading that is
/// none; as fitCalibration().
[[nodiscard]] Result<nlohmann::json> calibrationOf(ScriptSession& session, const nlohmann::json& readings,
                                                   const CalibrationAsked& asked);

}  // namespace tacto::host::analysis
