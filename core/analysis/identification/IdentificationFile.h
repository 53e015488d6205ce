// IdentificationFile.h - the table that `analyze identification` reads.
//
// Thread-safety: pure functions on files.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/analysis/identification/Identification.h"

namespace tacto {

struct ParticipantTrials {
    std::string participant;  ///< empty in a table without that column
    std::string basis;        ///< "person", "virtual participant": as the table says; empty where it does not
    std::vector<IdentificationTrial> trials;
};

/// Trials from columns `stimulus` (or `condition`, or `trial_type`, as the BIDS export names it) and `response`, by
/// `participant` where that column is there, and with `trial`, `block`, `phase`, `attempt` and `response_time` (or
/// `rt_s`), and `basis`, on whom the answers rest. Comma, semicolon or tab. "not_sure" is read as "not-sure"; an empty
/// response or n/a is not an answer. A row without a phase is a test trial. Errors: NotFound, Io; ParseError naming
/// file, line and what was expected.
[[nodiscard]] Result<std::vector<ParticipantTrials>> readIdentificationTrials(const std::filesystem::path& path);
/// Reads them from text; `name` stands for the file in messages.
[[nodiscard]] Result<std::vector<ParticipantTrials>> parseIdentificationTrials(std::string_view text,
                                                                               std::string_view name);

}  // namespace tacto
