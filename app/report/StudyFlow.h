// StudyFlow.h - what an ethics committee asks of a study: approval and consents, how far each participant came, what
// was done to the skin, what went wrong. Participants have the labels of the export, never codes.
#pragma once

#include "app/report/ReportContent.h"
#include "core/sharing/results/StudyResults.h"

namespace tacto {

[[nodiscard]] FactsBlock approvalFacts(const StudyRecord& study);
[[nodiscard]] FactsBlock procedureFacts(const StudyRecord& study);
/// Every enrolled participant is in it, withdrawn ones as a number alone.
[[nodiscard]] TableBlock flowTable(const StudyRecord& study, SessionBasis basis, const QString& caption);
/// Drift of the detection threshold over the blocks, and exposure, a row a session.
enum class ShownName { Code, Label };
[[nodiscard]] TableBlock courseTable(const StudyRecord& study, ShownName name, const QString& caption);
[[nodiscard]] TableBlock careTable(const StudyRecord& study, const QString& caption);
/// Side effects before, after and on a day after each session, and "not asked" where nobody asked.
[[nodiscard]] TableBlock sideEffectsTable(const StudyRecord& study, ShownName name, const QString& caption);
[[nodiscard]] TableBlock refusalsTable(const StudyRecord& study, const QString& caption);
[[nodiscard]] TableBlock eventsTable(const StudyRecord& study, const QString& caption);

}  // namespace tacto
