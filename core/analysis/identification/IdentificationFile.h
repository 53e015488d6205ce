// IdentificationFile.h - reads the table of trials for `analyze identification`.
//
// Thread-safety: pure functions on files.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/analysis/identification/Identification.h"

namespace tacto {

/// The trials of one session with one encoding; both names are empty if the table has no such column.
struct TableSession {
    std::string session, encoding;
    std::vector<IdentificationTrial> trials;
};

struct ParticipantTrials {
    std::string participant;             ///< empty if the table has no such column
    std::string basis;                   ///< "person" or "virtual participant" as in the table; empty if absent
    std::vector<TableSession> sessions;  ///< in the order of first appearance
    /// Returns the trials of all sessions. With several sessions each trial gets a number of its own.
    [[nodiscard]] std::vector<IdentificationTrial> trials() const;
};

/// Reads trials from the columns `stimulus` (or `condition`, or `trial_type` as in the BIDS export) and `response`.
/// Optional columns: `participant`, `session`, `encoding`, `trial`, `block`, `phase`, `attempt`, `response_time` (or
/// `rt_s`) and `basis` (the kind of participant). Separated by comma, semicolon or tab. "not_sure" is read as
/// "not-sure". An empty response or n/a means no answer. A row without a phase is a test trial. Errors: NotFound, Io;
/// ParseError naming file, line and expectation.
[[nodiscard]] Result<std::vector<ParticipantTrials>> readIdentificationTrials(const std::filesystem::path& path);
/// Reads the same table from text; `name` replaces the file name in messages.
[[nodiscard]] Result<std::vector<ParticipantTrials>> parseIdentificationTrials(std::string_view text,
                                                                               std::string_view name);

}  // namespace tacto
