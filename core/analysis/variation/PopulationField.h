// PopulationField.h - the figures that a population of virtual people is given by: what each is called, its unit and
// what is accepted. validate() and the script function analysis.variation() both take them from here.
//
// Thread-safety: constants and pure functions.
#pragma once

#include <span>
#include <string_view>

#include "core/analysis/variation/VirtualParticipant.h"
#include "core/base/ValueKind.h"

namespace tacto {

struct PopulationField {
    std::string_view key;       ///< "detection_ma"
    std::string_view name;      ///< "median perception threshold"
    std::string_view holdsFor;  ///< what the name leaves out: "at 150 us per phase"; may be empty
    AcceptedNumbers accepted;
    double& (*in)(PopulationModel&);
};

/// One for each figure that is set individually. Geometric standard deviations are set for several at once.
[[nodiscard]] std::span<const PopulationField> populationFields() noexcept;

/// Geometric standard deviations; 1: all people are alike.
inline constexpr AcceptedNumbers kAcceptedSpread{.low = 1, .high = 10};

}  // namespace tacto
