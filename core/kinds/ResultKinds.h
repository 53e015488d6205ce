// ResultKinds.h - finds a kind of results by the name in its `kind` member. Only this file compares such names; the app
// uses the enum ResultKind.
#pragma once

#include <string_view>

#include "core/results/ResultKind.h"

namespace tacto {

/// Returns the traits of the kind with that name, or those of Other if there is none.
[[nodiscard]] const ResultTraits& resultTraits(std::string_view name);

/// Returns the results that a report keeps: the kind and all that its tables show. Null for results without a kind.
[[nodiscard]] nlohmann::json shownInReports(const nlohmann::json& results);

}  // namespace tacto
