// RunAnalysis.h - judgements and predictions, for the object "analysis" and for the steps of protocols.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptSession.h"
#include "core/analysis/calibration/CalibrationVerdict.h"
#include "core/analysis/separability/Separability.h"
#include "core/analysis/transitions/ComputedTransitions.h"
#include "core/analysis/variation/Variation.h"

namespace tacto::host::analysis {

using Json = nlohmann::json;

struct CalibrationAsked {
    std::string quantity = "amplitude";
    double tolerance_pct = 2;  ///< relative to the command at each level
    CalibrationOptions fit;
    /// The readings state the instrument's errors; the errors here may enlarge them.
    InstrumentErrors errors;
};
/// Returns the calibration of one quantity as analysis.calibration() does and takes the same `readings`. Errors:
/// InvalidArgument for an entry that is no reading; as fitCalibration().
[[nodiscard]] Result<Json> calibrationOf(ScriptSession& session, const Json& readings, const CalibrationAsked& asked);

/// Judges trials as analysis.separability() does. Errors: InvalidArgument naming the called function.
[[nodiscard]] Result<Separability> separabilityOf(const Arguments& arguments, const Json& trials,
                                                  std::vector<std::string> conditions);

/// Returns the members lines, traverse_s and jumps of "options" or "settings".
[[nodiscard]] std::vector<HostParameter> sweepSettings(bool ofOptions);
/// Computes the transitions of the present encoding as analysis.transitions() does.
[[nodiscard]] Result<ComputedTransitions> computedTransitions(ScriptSession& session, const Arguments& arguments,
                                                              int lines, double traverse_s, bool jumps);

/// Returns the parameters that are options of analysis.variation().
[[nodiscard]] std::vector<HostParameter> variationParameters();
/// Takes profile and limits from the bench, its stimulator too if it drives as requested, and the seed from the run.
/// Errors: InvalidArgument for thresholds in the wrong order.
[[nodiscard]] Result<VariationOptions> variationOptionsFrom(ScriptSession& session, const Arguments& arguments);
/// Errors: if the run is stopped; the prediction up to then is kept as partial.
[[nodiscard]] Result<Variation> predicted(ScriptSession& session, const VariationOptions& options,
                                          const std::string& label);

}  // namespace tacto::host::analysis
