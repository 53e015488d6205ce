// LoadSafetyTables.h - a judged load-safety check as the tables of its report, closest to a limit first.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>

namespace tacto::host::report {

/// Report tables for the result of analysis.loadSafety(): a list of { caption, rows, columns }, and kind for matrices.
[[nodiscard]] nlohmann::json loadSafetyTables(const nlohmann::json& found);

}  // namespace tacto::host::report
