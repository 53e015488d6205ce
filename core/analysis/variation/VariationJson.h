// VariationJson.h - writes a prediction as JSON in the format of the command-line contract.
//
// Counts are of participants; "refused", "not_felt" and "withheld" count pairs of participant and condition. "served"
// are participants for whom every condition is presented, felt and not too strong. Confusion, accuracy, accuracies,
// information, trials and pilots cover these. "clearly_separable_share" is a share of all participants. "model" holds
// the medians and constants used for drawing, "people" the first 1000 participants.
//
// "value" of an interval is the median over participants; "low" and "high" are their 5 and 95 % quantiles. The number
// of threads is absent because it does not affect the result.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/variation/Variation.h"
#include "core/analysis/variation/VariationBench.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// `options` are those of this prediction. The trials are null if no participant is served.
[[nodiscard]] nlohmann::json toJson(const Variation& found, const VariationOptions& options);
[[nodiscard]] nlohmann::json toJson(const BenchVariation& found);

// What a run of the protocol adds to its prediction.

/// Who is served if another level is too strong.
struct ComfortReading {
    std::string_view tooStrongFrom;
    double median_ma;
    const Variation& fixed;     ///< with the profile's amplitudes
    const Variation& personal;  ///< with personal amplitudes
};
[[nodiscard]] nlohmann::json toJson(const ComfortReading& reading);

[[nodiscard]] constexpr AmplitudeLevels otherThan(AmplitudeLevels levels) noexcept {
    return levels == AmplitudeLevels::Personal ? AmplitudeLevels::Profile : AmplitudeLevels::Personal;
}

struct VariationRun {
    [[nodiscard]] const Variation& with(AmplitudeLevels levels) const noexcept {
        return options.stimulation.levels == levels ? found : other;
    }

    VariationOptions options = {};
    Variation found = {};
    Variation other = {};  ///< of the same participants, with the other levels
    nlohmann::json readings = nlohmann::json::array();
    BenchVariation bench = {};
    std::string fixedRange = {};            ///< the name of the profile's range
    std::vector<std::string> reasons = {};  ///< what is said of the result, together its headline
};
/// Returns the results of the protocol.
[[nodiscard]] nlohmann::json toJson(const VariationRun& run);
[[nodiscard]] std::vector<std::string> variationRunMembers();

// The premises of a prediction: each figure has a source or is marked as the authors' choice.

enum class PremiseMark {
    Source,  ///< the value is taken from the source
    Choice,  ///< no clear source was found; replace it with the laboratory's own value
    Set,     ///< changed from the shipped value by the operator, who is responsible for it
};
[[nodiscard]] std::string_view nameOf(PremiseMark mark) noexcept;  // "source", "choice", "set"

struct Premise {
    std::string quantity;
    std::string value;   ///< median, with its unit
    std::string spread;  ///< geometric standard deviation with its own mark, for example "1.4 (choice)", since no
                         ///< source gives it; empty if all people share one value
    PremiseMark mark = PremiseMark::Choice;
    std::string source;  ///< source of the shipped value; for a choice, a sentence on its basis
};

/// Lists the premises in the order of the chain: thresholds, skin, discrimination, levels.
[[nodiscard]] std::vector<Premise> premisesOf(const VariationOptions& options);

/// Describes how a prediction is shown.
[[nodiscard]] ResultTraits variationKind();

}  // namespace tacto
