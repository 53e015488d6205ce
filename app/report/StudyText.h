// StudyText.h - formats texts and numbers of a study for its reports.
#pragma once

#include <QString>
#include <string>

#include "core/analysis/statistics/Estimate.h"
#include "core/study/Participant.h"

namespace tacto {

[[nodiscard]] inline QString qtext(const std::string& value) { return QString::fromStdString(value); }
/// Returns "People", "Virtual participants".
[[nodiscard]] QString peopleHeading(SessionBasis basis);
/// Returns "–" for an unknown value.
[[nodiscard]] QString figureText(double value, int decimals);
/// Returns "85 % (76 to 91)", or "–" for an unknown share.
[[nodiscard]] QString shareText(const Estimate& share);

}  // namespace tacto
