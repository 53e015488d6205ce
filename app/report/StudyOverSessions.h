// StudyOverSessions.h - one participant's sessions: thresholds, range and answers, compared with the first session.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/report/ReportContent.h"
#include "core/sharing/results/StudyFigures.h"

namespace tacto {

/// Compares all sessions, even those without test trials. Adds nothing for fewer than two. `massager`: levels are
/// strengths. Errors: as compareSessions().
[[nodiscard]] Result<void> addOverSessions(std::vector<ReportBlock>& blocks, Captions& captions,
                                           const std::string& name, const std::vector<AnalysedSession>& sessions,
                                           bool massager);

// Which of several encodings people prefer. The report shows the order in which they had them, but no statistical test:
// even if five of five people agree, p is only 0.06.

/// Returns "Easier to tell: swapped. More like touch: no difference."; empty if the person was not asked.
[[nodiscard]] QString preferenceText(const ParticipantRecord& participant);

/// Returns a row per encoding and one for no difference, without a caption; nothing if no participant was asked.
[[nodiscard]] std::optional<TableBlock> preferencesTable(const StudyRecord& study);
/// Returns the orders in which those people had the encodings, whether they are balanced, and why there is no test.
[[nodiscard]] QString preferencesNote(const StudyRecord& study);

// Compares the person's answers with the answers of a model person who has the same thresholds (pilot.md section 8).
// The comparison is shown, never judged: a person's Weber fraction of interval is not known, and the Weber fraction of
// amplitude only if they compared strengths.

/// `weber`: the person's own for amplitude; NaN if not measured. Adds nothing if the session has no detection
/// threshold, or if its test did not present every condition. Errors: as VirtualObserver::create().
[[nodiscard]] Result<void> addPredicted(std::vector<ReportBlock>& blocks, Captions& captions, const QString& caption,
                                        const AnalysedSession& one, double weber, bool massager);

}  // namespace tacto
