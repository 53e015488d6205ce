// StudyOverSessions.h - one participant over their sessions: thresholds, range and answers, each against the first.
#pragma once

#include <optional>
#include <string>
#include <vector>

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

// Which of several encodings people say they prefer. Shown with the order in which they had them, and never tested: if
// five of five people agree, p is 0.06.

/// "Easier to tell: swapped. More like touch: no difference."; empty where the person was not asked.
[[nodiscard]] QString preferenceText(const ParticipantRecord& participant);

/// A row for each encoding, and one for no difference; without a caption. Empty where no participant was asked.
[[nodiscard]] std::optional<TableBlock> preferencesTable(const StudyRecord& study);
/// The orders in which those people had the encodings, whether they are balanced, and why nothing is tested.
[[nodiscard]] QString preferencesNote(const StudyRecord& study);

// What a model of a person with the thresholds of a session would have answered, beside what the person answered
// (pilot.md section 8). It is shown and never judged: a person's Weber fraction of interval is not known, and that of
// amplitude only where they compared strengths.

/// `weber`: their own, of amplitude; NaN where it was not measured. Nothing where the session has no detection
/// threshold, or some condition was not presented in its test. Errors: as VirtualObserver::create().
[[nodiscard]] Result<void> addPredicted(std::vector<ReportBlock>& blocks, Captions& captions, const QString& caption,
                                        const AnalysedSession& one, double weber, bool massager);

}  // namespace tacto
