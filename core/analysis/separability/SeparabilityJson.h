// SeparabilityJson.h - writes a judged separability as JSON in the command-line contract (cli.md), and reads its trials
// from JSON and from the tables of `analyze`.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "core/analysis/separability/Separability.h"
#include "core/base/Result.h"
#include "core/results/ResultKind.h"
#include "core/results/ResultRecord.h"

namespace tacto {

/// Reads a trial from measure.train() with its condition. A null or missing value was not measured; a null or missing
/// uncertainty was not stated. Errors: InvalidArgument for a row without a condition or a value of another type.
[[nodiscard]] Result<SeparabilityTrial> separabilityTrialFrom(const nlohmann::json& row);
/// {"condition","amplitude_v","interval_s","amplitude_u_v","interval_u_s","time_base_u",
/// "amplitude_gain_u"}
[[nodiscard]] nlohmann::json toJson(const SeparabilityTrial& trial);

/// Describe the members and columns of a condition and of a pair.
[[nodiscard]] const ResultRecord<ConditionSummary>& conditionRecord();
[[nodiscard]] const ResultRecord<PairSummary>& pairRecord();

/// A reference surface that was felt before the trials.
struct FeltReference {
    std::string material;
    double h = 0;  ///< vibration feature; NaN if this rig does not have it, as `v` of the taxels
    double v = 0;
    std::size_t frames = 0;  ///< number of readings in the means
};
[[nodiscard]] nlohmann::json toJson(const FeltReference& felt);

/// {"conditions","pairs","confusion","accuracy","verdict","reasons", ...}
[[nodiscard]] nlohmann::json toJson(const Separability& found);
/// Describes how a separability is judged and shown.
[[nodiscard]] ResultTraits separabilityKind();

/// Reads trials from the CSV columns `condition`, `amplitude`, `interval` (or `amplitude_v`, `interval_s` as in the csv
/// export), in any order and with other columns between; names are trimmed. An empty or nan value means not measured.
/// Errors: NotFound, Io; ParseError naming file, line and what was expected.
[[nodiscard]] Result<std::vector<SeparabilityTrial>> readSeparabilityTrials(const std::filesystem::path& path);
/// Reads the same table from text; `name` replaces the file name in messages.
[[nodiscard]] Result<std::vector<SeparabilityTrial>> parseSeparabilityTrials(std::string_view text,
                                                                             std::string_view name);

}  // namespace tacto
