// LoadSafetyTables.h - a judged load-safety check as the tables of its report, closest to a limit first.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>

namespace tacto::host::report {

/// Of what analysis.loadSafety() returned: a list of { caption, rows, columns }, matrices with their kind.
[[nodiscard]] nlohmann::json loadSafetyTables(const nlohmann::json& found);

}  // namespace tacto::host::report
