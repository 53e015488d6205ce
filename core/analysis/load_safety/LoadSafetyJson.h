// LoadSafetyJson.h - writes the load-safety check as JSON in the format of the command-line contract, and reads the
// records that a protocol script passes between its steps. Absent values are null.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/load_safety/LoadSafety.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// {"amplitude_v", "amplitude_v_u", ...}: each figure under its member's name, its standard uncertainty with the suffix
/// _u, and its U with the suffix _expanded.
[[nodiscard]] nlohmann::json toJson(const LoadReading& reading);
[[nodiscard]] nlohmann::json toJson(const SafetyRow& row);
/// Returns loads and worst_case (cli.md), and rows, disclosed, verdict and reasons.
[[nodiscard]] nlohmann::json toJson(const LoadSafety& found);

/// Reads {"command_v", "interval_s", "reading"}. Null means not measured. Errors: InvalidArgument, with the name of the
/// member and what is expected there.
[[nodiscard]] Result<LoadStep> loadStepFrom(const nlohmann::json& json);
/// Reads {"name", "dmm_ohm", "dmm_u_ohm", "serial", "steps": [{"command_v", "interval_s", "reading"}], "refusals":
/// [{"command_v", "interval_s", "forbidden", "refused", "predicted", "reason", "what"}], "undriven": [{"command_v",
/// "interval_s", "reason"}], "not_applicable", "problem"}; every member except the name is optional. Errors: those of
/// loadStepFrom() and of parseLoad().
[[nodiscard]] Result<LoadRecord> loadRecordFrom(const nlohmann::json& json);
/// Reads {"reference_v", "deviation_pct", "expanded_uncertainty_pct", "allowed_pct"} and judges them again.
[[nodiscard]] Result<SafetyRow> absoluteRowFrom(const nlohmann::json& json);
/// Reads {"name", "evaluated", "tripped", "after_s", "stop_s", "allowed_s", "reason"}.
[[nodiscard]] Result<TripTrial> tripTrialFrom(const nlohmann::json& json);

/// Describes how this kind of result is judged and shown.
[[nodiscard]] ResultTraits loadSafetyKind();

}  // namespace tacto
