// IdentificationFile.h - the table that `analyze identification` reads.
//
// Thread-safety: pure functions on files.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/analysis/identification/IdentificationTrial.h"

namespace tacto {

/// Test trials from columns `condition` (or `trial_type`, as the BIDS export names it) and `response`; `block`,
/// `phase`, `attempt` and `response_time` (or `rt_s`) where they are there. Comma, semicolon or tab. "not_sure" is read
/// as "not-sure"; an empty response or n/a is no answer. A row without a phase is a test trial. Errors: NotFound, Io;
/// ParseError naming file, line and what was expected.
[[nodiscard]] Result<std::vector<IdentificationTrial>> readIdentificationTrials(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in messages.
[[nodiscard]] Result<std::vector<IdentificationTrial>> parseIdentificationTrials(std::string_view text,
                                                                                 std::string_view name);

}  // namespace tacto
