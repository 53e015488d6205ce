// VariationJson.h - a prediction in the shape of the command line's contract.
//
//   {"simulated": true, "measured": false, "participants", "asked", "partial", "seed", "conditions": [{"name",
//    "presented", "refused", "not_felt", "current_ma", "voltage_v", "interval_s"}],
//    "separability": [{"a", "b", "participants", "jnd": {"value", "low", "high"}, "amplitude_jnd", "interval_jnd"}],
//    "labels", "columns", "confusion", "complete", "accuracy": {"median", "low", "high"}, "pooled_accuracy", "it_bits",
//    "it_bias_bits", "it_corrected_bits", "information_bits", "clearly_separable_share", "refused", "not_felt",
//    "withheld": [{"reason", "count"}], "accuracies", "impedance_ohm", "detection_ma", "discomfort_ma",
//    "trials_needed": {"width", "assurance", "chance", "per_participant": {"for_width", "above_chance"}, "pooled":
//    {"participants", "rho", "for_width": {"total", "per_participant", "design_effect", "participants_least"},
//    "above_chance"}, "curve": [{"trials", "width"}], "assumptions"}}
//
// An interval's value is the median over participants, low and high are 5 and 95 % of them. The number of threads is
// not in it: it has no influence.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/Variation.h"
#include "core/analysis/VariationBench.h"

namespace tacto {

/// `options` are those that made it; the trials are null where nobody could be presented everything.
[[nodiscard]] nlohmann::json toJson(const Variation& found, const VariationOptions& options);
/// {"draws", "conditions": [{"name", "amplitude_v", "interval_s"}], "pairs": [{"a", "b", "amplitude_jnd",
/// "interval_jnd"}]}
[[nodiscard]] nlohmann::json toJson(const BenchVariation& found);

}  // namespace tacto
