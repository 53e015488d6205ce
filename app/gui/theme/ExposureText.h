// ExposureText.h - an exposure against its limit in words: both in the unit of the limit, so that the eye compares
// numbers, with no more decimals than matter beside the limit.
//
// Thread-safety: pure functions.
#pragma once

#include <QString>

#include "core/safety/Exposure.h"

namespace tacto::gui {

/// "0.69" and "mA" of 690 µA against 10 mA; "0" of nothing at all, "< 0.01" below what is told apart beside the limit,
/// "> 10" where it is above the limit and would read as at it. Without a limit in its own unit.
struct ExposureFigure {
    QString number;
    QString unit;  ///< empty for a number without one
};
[[nodiscard]] ExposureFigure figureOf(const ExposureRow& row);

/// "0.69 mA".
[[nodiscard]] QString valueText(const ExposureRow& row);
/// "0.69 of 10 mA", "> 10 mA". A density's limit is without "/cm²", which its title has.
[[nodiscard]] QString valueOfLimitText(const ExposureRow& row);
/// "45.3 V measured": what an instrument showed of what was set; with "⚠" where the source's accuracy does not explain
/// it. Empty where none did.
[[nodiscard]] QString measuredText(const ExposureRow& row);

}  // namespace tacto::gui
