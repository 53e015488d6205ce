// TrialFile.h - the tables that `analyze` reads.
//
// Thread-safety: pure functions on files.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/analysis/separability/Separability.h"
#include "core/base/Result.h"

namespace tacto {

/// Trials from CSV columns `condition`, `amplitude`, `interval` (or `amplitude_v`, `interval_s`, as the csv export
/// writes them), in any order among others; names are trimmed. An empty or nan value is a trial that was not measured.
/// Errors: NotFound, Io; ParseError naming file, line and what was expected.
[[nodiscard]] Result<std::vector<SeparabilityTrial>> readSeparabilityTrials(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in messages.
[[nodiscard]] Result<std::vector<SeparabilityTrial>> parseSeparabilityTrials(std::string_view text,
                                                                             std::string_view name);

}  // namespace tacto
