// RunAnalysis.h - what is judged and predicted, for the object "analysis" and for the steps of protocols.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptSession.h"
#include "core/analysis/calibration/CalibrationVerdict.h"
#include "core/analysis/variation/Variation.h"

namespace tacto::host::analysis {

using Json = nlohmann::json;

struct CalibrationAsked {
    std::string quantity = "amplitude";
    double tolerance_pct = 2;  ///< relative to the command at each level
    CalibrationOptions fit;
    /// The instrument's own statements come from the readings; these may widen them.
    InstrumentErrors errors;
};
/// The calibration of one quantity as analysis.calibration() returns it; `readings` as it takes them. Errors:
/// InvalidArgument for an entry that is no reading; as fitCalibration().
[[nodiscard]] Result<Json> calibrationOf(ScriptSession& session, const Json& readings, const CalibrationAsked& asked);

/// The result of analysis.separability(). Errors: InvalidArgument named after the function that was called.
[[nodiscard]] Result<Json> separabilityOf(const Arguments& arguments, const Json& trials,
                                          std::vector<std::string> conditions);

/// Members lines, traverse_s and jumps of "options" or "settings".
[[nodiscard]] std::vector<HostParameter> sweepSettings(bool ofOptions);
/// The result of analysis.transitions(), by the encoding in force.
[[nodiscard]] Result<Json> computedTransitions(ScriptSession& session, const Arguments& arguments, int lines,
                                               double traverse_s, bool jumps);

/// The options of analysis.variation().
[[nodiscard]] std::vector<HostParameter> variationParameters();
/// Profile, limits and, where it drives as asked, the stimulator are the bench's, the seed is the run's. Errors:
/// InvalidArgument for thresholds that are not in order.
[[nodiscard]] Result<VariationOptions> variationOptionsFrom(ScriptSession& session, const Arguments& arguments);
/// Errors: when the run is stopped; what was predicted until then is kept as partial.
[[nodiscard]] Result<Variation> predicted(ScriptSession& session, const VariationOptions& options,
                                          const std::string& label);

}  // namespace tacto::host::analysis
