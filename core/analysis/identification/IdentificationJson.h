// IdentificationJson.h - an identification session's figures in the shapes of the command line's contract (pilot.md
// section 10): the same for `run pilot-identification`, `analyze identification` and reports. Absent values are null.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/identification/FewPeople.h"
#include "core/analysis/identification/Identification.h"
#include "core/analysis/identification/OverSessions.h"
#include "core/results/ResultTable.h"

namespace tacto {

/// {"labels", "columns", "confusion", "n", "hits", "accuracy", "p_chance", "it_bits", "it_bias_bits",
/// "it_corrected_bits", "it_corrected_low_bits", "it_corrected_high_bits", "texture", "pressure", "catch", "no_answer",
/// "blocks", "shares", "learning", "sequence", "median_rt_s"}. The caller adds what it alone knows: participant, parts,
/// range, drift, predicted, ...
[[nodiscard]] nlohmann::json toJson(const Identification& found);
/// How they are shown.
[[nodiscard]] const std::vector<ResultTable>& identificationTables();
/// {"n", "hits", "accuracy", "p_chance", "it_bits", "it_bias_bits", "it_corrected_bits", "it_corrected_low_bits",
/// "it_corrected_high_bits"}: as counted, what is taken off, what is left and its 95 % interval
[[nodiscard]] nlohmann::json toJson(const ConfusionFigures& figures);
/// The corrected information of such figures, with its interval; NaN for a missing value.
[[nodiscard]] Estimate correctedBitsFrom(const nlohmann::json& figures);
/// {"number", "phase", "block", "condition", "response", "attempt", "rt_s"}; response null without an answer
[[nodiscard]] nlohmann::json toJson(const IdentificationTrial& trial);
/// The trial in the body of a session's row of an answer, or of none; what is missing keeps its default.
[[nodiscard]] IdentificationTrial identificationTrialFrom(const nlohmann::json& row);
/// {"people", "left_out": [{"name", "reason"}], "accuracy": {"median", "min", "max"}, "it_corrected_bits",
/// "above_chance": {"k", "n", "share", "prevalence", "prevalence_at_least"}}; the last is the lower end of the one
/// before
[[nodiscard]] nlohmann::json toJson(const FewPeople& people);
/// {"encodings", "pairs": [{"a", "b", "difference"}], "preferred"}
[[nodiscard]] nlohmann::json toJson(const EncodingComparison& compared);

}  // namespace tacto
