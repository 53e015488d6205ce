// LoadSafetyJson.h - the load-safety check in the shapes of the command line's contract, and the records that a
// protocol script carries between its steps. Absent values are null.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/load_safety/LoadSafety.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// {"amplitude_v", "amplitude_v_u", ...}: each figure by its member's name, its standard uncertainty with _u, its U
/// with _expanded.
[[nodiscard]] nlohmann::json toJson(const LoadReading& reading);
[[nodiscard]] nlohmann::json toJson(const SafetyRow& row);
/// cli.md: loads, worst_case; and rows, disclosed, verdict, reasons.
[[nodiscard]] nlohmann::json toJson(const LoadSafety& found);

/// {"command_v", "interval_s", "reading"}. Errors: InvalidArgument naming the member and what is expected there. Null
/// is not measured.
[[nodiscard]] Result<LoadStep> loadStepFrom(const nlohmann::json& json);
/// {"name", "dmm_ohm", "dmm_u_ohm", "serial", "steps": [{"command_v",
/// "interval_s", "reading"}],
///  "refusals": [{"command_v", "interval_s", "forbidden", "refused", "predicted", "reason", "what"}],
///  "undriven": [{"command_v", "interval_s", "reason"}], "not_applicable", "problem"}; all but the name may be left
///  out. Errors: as loadStepFrom(); as parseLoad().
[[nodiscard]] Result<LoadRecord> loadRecordFrom(const nlohmann::json& json);
/// {"reference_v", "deviation_pct", "expanded_uncertainty_pct", "allowed_pct"}, judged again.
[[nodiscard]] Result<SafetyRow> absoluteRowFrom(const nlohmann::json& json);
/// {"name", "evaluated", "tripped", "after_s", "stop_s", "allowed_s", "reason"}
[[nodiscard]] Result<TripTrial> tripTrialFrom(const nlohmann::json& json);

/// How a check is judged and shown.
[[nodiscard]] ResultTraits loadSafetyKind();

}  // namespace tacto
