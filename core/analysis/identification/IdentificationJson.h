// IdentificationJson.h - writes an identification session's figures as JSON in the command-line contract (pilot.md
// section 10), shared by `run pilot-identification`, `analyze identification` and reports. Absent values are null.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/identification/EncodingsOverPeople.h"
#include "core/analysis/identification/FewPeople.h"
#include "core/analysis/identification/Identification.h"
#include "core/analysis/identification/OverSessions.h"
#include "core/results/ResultKind.h"
#include "core/results/ResultTable.h"

namespace tacto {

/// {"labels", "columns", "confusion", "n", "hits", "accuracy", "p_chance", "it_bits", "it_bias_bits",
/// "it_corrected_bits", "it_corrected_low_bits", "it_corrected_high_bits", "texture", "pressure", "catch", "no_answer",
/// "blocks", "shares", "learning", "sequence", "median_rt_s"}. The caller adds its own members: participant, parts,
/// range, drift, predicted, ...
[[nodiscard]] nlohmann::json toJson(const Identification& found);
/// Returns the tables that show an identification session.
[[nodiscard]] const std::vector<ResultTable>& identificationTables();
/// {"n", "hits", "accuracy", "p_chance", "it_bits", "it_bias_bits", "it_corrected_bits", "it_corrected_low_bits",
/// "it_corrected_high_bits"}: raw information, its bias, the corrected value and its 95 % interval
[[nodiscard]] nlohmann::json toJson(const ConfusionFigures& figures);
/// Reads the corrected information with its interval from such JSON; NaN for a missing value.
[[nodiscard]] Estimate correctedBitsFrom(const nlohmann::json& figures);
/// {"number", "phase", "block", "condition", "response", "attempt", "rt_s"}; "response" is null without an answer.
[[nodiscard]] nlohmann::json toJson(const IdentificationTrial& trial);
/// Reads a trial from a session's row for an answer or a missing answer. Missing members keep their defaults.
[[nodiscard]] IdentificationTrial identificationTrialFrom(const nlohmann::json& row);
/// {"people", "left_out": [{"name", "reason"}], "accuracy": {"median", "min", "max"}, "it_corrected_bits",
/// "above_chance": {"k", "n", "share", "prevalence", "prevalence_at_least"}}; "prevalence_at_least" is the lower end of
/// "prevalence".
[[nodiscard]] nlohmann::json toJson(const FewPeople& people);
/// {"encodings": [{"participant", "encoding", "sessions", "n", "hits", "accuracy", "it_corrected_bits", ...}],
/// "differences": [{"of", "participant", "points", "bits", "first", "p"}], "better", "sentences"}; the last row of each
/// pair is the mean over people
[[nodiscard]] nlohmann::json toJson(const EncodingsOverPeople& found);

/// {"kind", "sessions": [{"participant", "number", "days", "encoding", "detection", "too_strong", "low", "high",
/// "unit", "impedance_ohm", "hits", "n", "accuracy", "it_corrected_bits", ..., "median_rt_s"}] and the members of the
/// encodings
[[nodiscard]] nlohmann::json toJson(const StudyFigures& found);
[[nodiscard]] ResultTraits studyFiguresKind();

}  // namespace tacto
