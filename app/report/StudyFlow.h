// StudyFlow.h - what an ethics committee asks about a study: approval and consents, the progress of each participant,
// the condition of the skin, what went wrong. Participants have the labels of the export, never codes.
#pragma once

#include "app/report/ReportContent.h"
#include "core/sharing/results/StudyResults.h"

namespace tacto {

[[nodiscard]] FactsBlock approvalFacts(const StudyRecord& study);
[[nodiscard]] FactsBlock procedureFacts(const StudyRecord& study);
/// Returns what a reader of the results asks (StudyLog.h); what was not noted is unknown.
[[nodiscard]] FactsBlock particularsFacts(const StudyRecord& study);
/// Returns a table of all notes of that kind; without rows if there are none.
[[nodiscard]] TableBlock notesTable(const StudyRecord& study, const StudyLogKind& kind, const QString& caption);
/// Why people were not enrolled, and why they left.
[[nodiscard]] TableBlock reasonsTable(const StudyRecord& study, const QString& caption);
/// Contains every enrolled participant; the withdrawn only as a number.
[[nodiscard]] TableBlock flowTable(const StudyRecord& study, SessionBasis basis, const QString& caption);
/// Drift of the detection threshold over the blocks, and exposure; one row per session.
enum class ShownName { Code, Label };
[[nodiscard]] TableBlock courseTable(const StudyRecord& study, ShownName name, const QString& caption);
[[nodiscard]] TableBlock careTable(const StudyRecord& study, const QString& caption);
/// Side effects before, after and on a day after each session, and "not asked" if the question was not asked.
[[nodiscard]] TableBlock sideEffectsTable(const StudyRecord& study, ShownName name, const QString& caption);
[[nodiscard]] TableBlock refusalsTable(const StudyRecord& study, const QString& caption);
[[nodiscard]] TableBlock eventsTable(const StudyRecord& study, const QString& caption);

}  // namespace tacto
