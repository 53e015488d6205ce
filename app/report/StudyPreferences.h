// StudyPreferences.h - which of several encodings people say they prefer. Shown with the order in which they had them,
// and never tested: five alike of five people have p = 0.06.
//
// Thread-safety: pure functions.
#pragma once

#include <optional>

#include "app/report/ReportContent.h"
#include "core/sharing/results/StudyResults.h"

namespace tacto {

/// "Easier to tell: swapped. More like touch: no difference."; empty where the person was not asked.
[[nodiscard]] QString preferenceText(const ParticipantRecord& participant);

/// A row for each encoding, and one for no difference; without a caption. Empty where no participant was asked.
[[nodiscard]] std::optional<TableBlock> preferencesTable(const StudyRecord& study);
/// The orders in which those people had the encodings, whether they are balanced, and why nothing is tested.
[[nodiscard]] QString preferencesNote(const StudyRecord& study);

}  // namespace tacto
