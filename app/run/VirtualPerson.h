// VirtualPerson.h - the virtual participant in a pilot run's settings: seed, answers to the checklist, and what they
// feel.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "core/analysis/psychophysics/VirtualObserver.h"
#include "core/base/Result.h"
#include "core/study/Gates.h"
#include "core/study/StudySettings.h"

namespace tacto {

/// Returns the seed in "virtual:SEED", nothing for a code. Errors: NotFound for a seed that is no whole number from 0.
[[nodiscard]] Result<std::optional<std::uint64_t>> virtualSeed(std::string_view participant);

/// Answers No to each item of the checklist except that in "exclusions" of `parameters`. Errors: InvalidArgument for an
/// item that the checklist does not have.
[[nodiscard]] Result<std::vector<ExclusionAnswer>> virtualAnswers(const nlohmann::json& parameters,
                                                                  const StudySettings& study = {});

/// Returns participant `seed` of the population in `parameters`, with the electrode and pulse of `study`. Errors: as
/// validate(PopulationModel) and VirtualObserver::create().
[[nodiscard]] Result<VirtualObserver> virtualObserver(const nlohmann::json& parameters, const StudySettings& study,
                                                      std::uint64_t seed, LevelUnit unit);

}  // namespace tacto
