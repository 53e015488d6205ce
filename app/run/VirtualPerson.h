// VirtualPerson.h - the virtual participant that a pilot run's settings describe: seed, answers to the checklist, and
// what they feel.
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

/// The seed in "virtual:SEED"; nothing in a code. Errors: NotFound for another seed than a whole number from 0.
[[nodiscard]] Result<std::optional<std::uint64_t>> virtualSeed(std::string_view participant);

/// Answers No to each item of the checklist but the one that `parameters` name as "exclusions". Errors: InvalidArgument
/// for an item that the checklist does not have.
[[nodiscard]] Result<std::vector<ExclusionAnswer>> virtualAnswers(const nlohmann::json& parameters);

/// Participant `seed` of the population that `parameters` describe, under the electrode and pulse of `study`. Errors:
/// as validate(PopulationModel) and VirtualObserver::create().
[[nodiscard]] Result<VirtualObserver> virtualObserver(const nlohmann::json& parameters, const StudySettings& study,
                                                      std::uint64_t seed, LevelUnit unit);

}  // namespace tacto
