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
/// What the reference load was read as; nothing where there was none.
void printKnownLoad(const nlohmann::json& results);
/// The results of a calibration, a line per quantity, without the verdict.
void printCalibration(const nlohmann::json& results);
/// The results of a load-safety check, a line per load, what is to be disclosed, and every row that did not pass.
void printLoadSafety(const nlohmann::json& results);
/// What analysis.variation() predicted, as tables.
void printVariation(const nlohmann::json& results);
/// Each change with its largest step and its time, and the latencies; each encoding beside the others; how well the
/// references are told apart, and the scales.
void printTransitions(const nlohmann::json& results);
void printEncodingComparison(const nlohmann::json& results);
void printSensorCalibration(const nlohmann::json& results);
/// A pilot session's: thresholds and range; the answers to each condition, and how well they were told apart.
void printPilotThresholds(const nlohmann::json& results);
void printPilotIdentification(const nlohmann::json& results);
/// Any other protocol's results, a line each.
void printResults(const nlohmann::json& results);
/// The results of a separability run or analysis, as a table on stdout, without the verdict.
void printSeparability(const nlohmann::json& results);

}  // namespace tacto::cli
