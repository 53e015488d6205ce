// Verdicts.h - verdicts as exit codes and as text.
//
// Thread-safety: pure functions; those that print are as safe as Say.h.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace tacto::cli {

/// Returns pass 0, fail 1, indeterminate 5, stopped 4; 0 without a verdict (a protocol that makes no judgement).
[[nodiscard]] int exitForVerdict(std::string_view verdict) noexcept;

/// Prints the verdict in a word, then the reasons.
void printVerdict(std::string_view verdict, const std::vector<std::string>& reasons);
/// Prints the tables of a kind of results, except those that are too long for a screen.
void printTables(std::string_view kind, const nlohmann::json& results);
/// Prints results of a laboratory's own kind, one per line.
void printResults(const nlohmann::json& results);

}  // namespace tacto::cli
