// Verdicts.h - verdicts as exit codes and as text.
//
// Thread-safety: pure functions; the printing ones as Say.h.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace tacto::cli {

/// pass 0, fail 1, indeterminate 5, stopped 4; nothing (a protocol that judges nothing) 0.
[[nodiscard]] int exitForVerdict(std::string_view verdict) noexcept;

/// The verdict in a word, then why.
void printVerdict(std::string_view verdict, const std::vector<std::string>& reasons);
/// The tables of a kind of results, but for those that are too long for a screen.
void printTables(std::string_view kind, const nlohmann::json& results);
/// The results of a laboratory's own kind, a line each.
void printResults(const nlohmann::json& results);

}  // namespace tacto::cli
