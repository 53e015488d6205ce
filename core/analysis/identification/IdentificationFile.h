// IdentificationFile.h - reads the table of trials for `analyze identification`.
//
// Thread-safety: pure functions on files.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/analysis/identification/Identification.h"

namespace tacto {

struct ParticipantTrials {
    std::string participant;  ///< empty if the table has no such column
    std::string basis;        ///< "person" or "virtual participant" as in the table; empty if absent
    std::vector<IdentificationTrial> trials;
};

/// Reads trials from the columns `stimulus` (or `condition`, or `trial_type` as in the BIDS export) and `response`.
/// Optional columns: `participant`, `trial`, `block`, `phase`, `attempt`, `response_time` (or `rt_s`) and `basis` (the
/// kind of participant). Separated by comma, semicolon or tab. "not_sure" is read as "not-sure". An empty response or
/// n/a means no answer. A row without a phase is a test trial. Errors: NotFound, Io; ParseError naming file, line and
/// expectation.
[[nodiscard]] Result<std::vector<ParticipantTrials>> readIdentificationTrials(const std::filesystem::path& path);
/// Reads the same table from text; `name` replaces the file name in messages.
[[nodiscard]] Result<std::vector<ParticipantTrials>> parseIdentificationTrials(std::string_view text,
                                                                               std::string_view name);

}  // namespace tacto
