// SeparabilityJson.h - a judged separability in the shape of the command line's contract (cli.md), and its trials as
// JSON and as the tables that `analyze` reads.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "core/analysis/separability/Separability.h"
#include "core/base/Result.h"
#include "core/results/ResultKind.h"

namespace tacto {

/// A trial as measure.train() measured it, with its condition. Null and a missing key: not measured, or for an
/// uncertainty not stated. Errors: InvalidArgument for a row without a condition and for values of another type.
[[nodiscard]] Result<SeparabilityTrial> separabilityTrialFrom(const nlohmann::json& row);
/// {"condition","amplitude_v","interval_s","amplitude_u_v","interval_u_s","time_base_u",
/// "amplitude_gain_u"}
[[nodiscard]] nlohmann::json toJson(const SeparabilityTrial& trial);

/// {"conditions","pairs","confusion","accuracy","verdict","reasons", ...}
[[nodiscard]] nlohmann::json toJson(const Separability& found);
/// How they are judged and shown.
[[nodiscard]] ResultTraits separabilityKind();

/// Trials from CSV columns `condition`, `amplitude`, `interval` (or `amplitude_v`, `interval_s`, as the csv export
/// writes them), in any order among others; names are trimmed. An empty or nan value is a trial that was not measured.
/// Errors: NotFound, Io; ParseError naming file, line and what was expected.
[[nodiscard]] Result<std::vector<SeparabilityTrial>> readSeparabilityTrials(const std::filesystem::path& path);
/// Reads them from text; `name` stands for the file in messages.
[[nodiscard]] Result<std::vector<SeparabilityTrial>> parseSeparabilityTrials(std::string_view text,
                                                                             std::string_view name);

}  // namespace tacto
