// ResultKinds.h - the kinds of results, as their `kind` says it: the one place that compares names of kinds. What the
// app does by kind goes by ResultKind.
#pragma once

#include <string_view>

#include "core/results/ResultKind.h"

namespace tacto {

/// The traits of the kind with that name; those of Other where there is none.
[[nodiscard]] const ResultTraits& resultTraits(std::string_view name);

/// What a report keeps of results: what the tables of their kind show, with the kind. Null where it has none.
[[nodiscard]] nlohmann::json shownInReports(const nlohmann::json& results);

}  // namespace tacto
