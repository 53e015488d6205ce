// StudyText.h - texts and numbers of a study as its reports write them.
#pragma once

#include <QString>
#include <string>

#include "core/analysis/statistics/Estimate.h"
#include "core/study/Participant.h"

namespace tacto {

[[nodiscard]] inline QString qtext(const std::string& value) { return QString::fromStdString(value); }
/// "People", "Virtual participants".
[[nodiscard]] QString peopleHeading(SessionBasis basis);
/// "–" for an unknown value.
[[nodiscard]] QString figureText(double value, int decimals);
/// "85 % (76 to 91)"; "–" for an unknown share.
[[nodiscard]] QString shareText(const Estimate& share);

}  // namespace tacto
