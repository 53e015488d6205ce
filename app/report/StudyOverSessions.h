// StudyOverSessions.h - one participant over their sessions: thresholds, range and answers, each against the first.
//
// Thread-safety: pure functions.
#pragma once

#include <string>
#include <vector>

#include "app/report/Captions.h"
#include "app/report/ReportContent.h"
#include "core/analysis/identification/Identification.h"
#include "core/sharing/results/StudyResults.h"

namespace tacto {

/// One session with its figures.
struct AnalysedSession {
    const SessionRecord* session = nullptr;
    Identification found;
};

/// Mean over the conditions, 5 (totally natural) to 1 (totally unnatural); NaN without ratings.
[[nodiscard]] double naturalnessOf(const BidsSession& session);

/// Compares all sessions, also those without test trials. Nothing for fewer than two. `massager`: levels are strengths.
/// Errors: as compareSessions().
[[nodiscard]] Result<void> addOverSessions(std::vector<ReportBlock>& blocks, Captions& captions,
                                           const std::string& name, const std::vector<AnalysedSession>& sessions,
                                           bool massager);

}  // namespace tacto
