// VariationJson.h - a prediction in the shape of the command line's contract.
//
//   {"simulated": true, "measured": false, "participants", "asked", "partial", "seed", "range_v": [least, most],
//    "served", "participants_refused", "participants_not_feeling", "participants_without_range", "complete",
//    "conditions": [{"name", "presented", "refused", "not_felt", "counted", "draws_attention", "too_strong",
//    "not_tolerated", "current_ma", "voltage_v", "interval_s"}],
//    "separability": [{"a", "b", "participants", "jnd": {"value", "low", "high"}, "amplitude_jnd", "interval_jnd"}],
//    "labels", "columns", "confusion", "accuracy": {"median", "low", "high"}, "presented_accuracy", "pooled_accuracy",
//    "it_bits", "it_bias_bits", "it_corrected_bits", "information_bits", "clearly_separable",
//    "clearly_separable_share", "refused", "not_felt", "withheld": [{"reason", "count"}], "accuracies",
//    "impedance_ohm", "detection_ma", "attention_ma", "discomfort_ma", "intolerance_ma", "trials_needed": {"width",
//    "assurance", "chance", "per_participant": {"for_width", "above_chance"}, "pooled": {"participants", "rho",
//    "for_width": {"total", "per_participant", "design_effect", "participants_least"}, "above_chance"}, "curve":
//    [{"trials", "width"}], "assumptions"}, "pilots": [{"people", "trials", "right_from", "all_served",
//    "all_above_chance", "prevalence_all", "prevalence_but_one", "width"}], "premises": [{"quantity", "value",
//    "spread", "mark", "source"}], "model": {…}, "people": {column: [a value per participant]}}
//
// Counts are of participants, but "refused", "not_felt" and "withheld" of participants times conditions. A condition
// counts if it is presented, felt and not too strong; "served" are those for whom all count, and confusion, accuracy,
// accuracies, information, trials and pilots are theirs. "clearly_separable_share" is of all participants.
// "model" holds the medians and constants drawn with; "people" the first 1000.
//
// An interval's value is the median over participants, low and high are 5 and 95 % of them. The number of threads is
// not in it: it has no influence.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/variation/Variation.h"
#include "core/analysis/variation/VariationBench.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// `options` are those that made it; the trials are null where no participant is served.
[[nodiscard]] nlohmann::json toJson(const Variation& found, const VariationOptions& options);
/// {"draws", "conditions": [{"name", "amplitude_v", "interval_s"}], "pairs": [{"a", "b", "amplitude_jnd",
/// "interval_jnd"}]}
[[nodiscard]] nlohmann::json toJson(const BenchVariation& found);

// What a prediction rests on: each figure with its source, or said to be a choice of ours.

enum class PremiseMark {
    Source,  ///< the value is the source's
    Choice,  ///< no source was found, or several would do: replace it with the laboratory's own
    Set,     ///< other than shipped: the operator answers for it
};
[[nodiscard]] std::string_view nameOf(PremiseMark mark) noexcept;  // "source", "choice", "set"

struct Premise {
    std::string quantity;
    std::string value;   ///< median, with its unit
    std::string spread;  ///< geometric standard deviation and its own mark, "1.4 (choice)": no source gives one; empty
                         ///< for one value for all
    PremiseMark mark = PremiseMark::Choice;
    std::string source;  ///< source of the shipped value; for a choice what it leans on, in a sentence
};

/// The premises in the order of the chain: thresholds, skin, discrimination, levels. `options` of the prediction.
[[nodiscard]] std::vector<Premise> premisesOf(const VariationOptions& options);

/// How a prediction is shown.
[[nodiscard]] ResultTraits variationKind();

}  // namespace tacto
