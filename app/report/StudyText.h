// StudyText.h - numbers of a study as its reports write them.
//
// Thread-safety: pure functions.
#pragma once

#include <QString>

#include "core/analysis/statistics/Estimate.h"

namespace tacto {

/// "–" for what is not known.
[[nodiscard]] QString figureText(double value, int decimals);
/// "85 % (76 to 91)"; "–" for what is not known.
[[nodiscard]] QString shareText(const Estimate& share);

}  // namespace tacto
