// VariationPremises.h - what a prediction rests on: each figure with its source, or said to be a choice of ours.
//
// Thread-safety: pure functions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/variation/Variation.h"

namespace tacto {

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

/// In the order of the chain: thresholds, skin, discrimination, levels. `options` has been predicted with.
[[nodiscard]] std::vector<Premise> premisesOf(const VariationOptions& options);

}  // namespace tacto
